"""How well a posed body fits a frame: its surface the points, or its markers where they are all.

A motion-capture system measures some dozens of points, which say little of a surface and much of
the markers that they are.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from regkit.body.body import Body
from regkit.body.fit import BodyFit
from regkit.body.support import segment_supports
from regkit.observation import Landmarks, Observation
from regkit.skeleton import Pose
from regkit.system.arrays import Array, Indices

NEAR = 0.02
"""A marker is where it was measured within this fraction of the body's size: 3.4 cm of a person,
whose skin moves a centimetre or two over the bones."""


@dataclass(frozen=True)
class MarkerFit:
    """The markers of a posed body beside their measured places.

    Attributes:
        segments: Segment of each of the K markers that the recording has, (K,).
        gaps: Distance of each marker from its measured place, (K,) [m]; NaN if it is unmeasured.
        size: Size of the body [m].
    """

    segments: Indices
    gaps: Array
    size: float

    @classmethod
    def of(cls, body: Body, transforms: Array, landmarks: Landmarks) -> MarkerFit:
        """Returns the fit of a body with T_world_segment (S, 4, 4)."""
        names, rows = body.markers.names, landmarks.rows
        known = [at for at, name in enumerate(names) if name in rows]
        measured = landmarks.positions[[rows[names[at]] for at in known]].reshape(-1, 3)
        placed = body.markers.place(transforms)[known]
        gaps = np.linalg.norm(placed - measured, axis=1)
        return cls(body.markers.segments[known], gaps, body.size)

    @property
    def _near(self) -> Array:
        """Whether each marker is where it was measured, (K,)."""
        return np.asarray(np.nan_to_num(self.gaps, nan=np.inf) <= NEAR * self.size)

    def fit(self) -> BodyFit:
        """Returns the agreement with the measured places.

        Its distance is the median of the gaps, its inlier share that of the measured markers at
        their places, its coverage that of the recording's markers that are measured.
        """
        seen = np.isfinite(self.gaps)
        if not seen.any():
            return BodyFit(np.nan, 0.0, 0.0, np.nan, np.nan)
        return BodyFit(
            distance=float(np.median(self.gaps[seen])),
            inlier_share=float(self._near[seen].mean()),
            coverage=float(seen.mean()),
            misfit=np.nan,
            relief=np.nan,
        )

    def supports(self, segments: int) -> Array:
        """Returns the share of each segment's markers that are at their places, (S,).

        NaN for a segment without a marker in the recording.
        """
        own = np.bincount(self.segments, minlength=segments)
        near = np.bincount(self.segments, weights=self._near, minlength=segments)
        return np.where(own > 0, near / np.maximum(own, 1), np.nan)


def fit_to_data(body: Body, pose: Pose, data: Observation) -> tuple[BodyFit, Array]:
    """Returns the agreement of a posed body with the data of a frame, and the segments' supports.

    Args:
        body: The body.
        pose: Its pose.
        data: The data.

    Returns:
        The fit, and how well the data support each segment, (S,), from 0 to 1; NaN if unknown.
    """
    transforms = body.place(pose).transforms
    if data.landmarks is not None and data.landmarks.alone:
        markers = MarkerFit.of(body, transforms, data.landmarks)
        return markers.fit(), markers.supports(len(transforms))
    fit = BodyFit.of(body, pose, data.points, data.sight)
    return fit, segment_supports(body, transforms, data.points)
