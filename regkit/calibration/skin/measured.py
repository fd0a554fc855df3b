"""The data of one frame, and their distances to a skin in both directions and at the outline."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import numpy as np
import scipy
from numpy.typing import NDArray

from regkit.calibration.skin.outline import Outline
from regkit.calibration.skin.skin_distances import SkinDistances
from regkit.calibration.skin.skin_points import SkinPoints
from regkit.geometry.camera import Camera
from regkit.observation import Observation
from regkit.system.arrays import Array, Indices

MOST_POINTS = 2000
"""This many points of all frames together, spread evenly, determine the shape as well as all."""

MOST_SKIN_POINTS = 1500
"""Number of points of the skin whose distance to the data is asked, in all frames together."""

MOST_OUTLINE_POINTS = 900
"""Number of points of the outlines in all frames together."""

NEIGHBOURS = 8
"""Number of points of the skin near a pixel, of which that at the nearest depth corresponds."""

BESIDE = 2.0
"""A pixel is beside the skin if its nearest point in the picture is farther than this many of
the skin's own spacings."""

FAR = 0.06
"""A pixel does not see a point of the skin that is this far behind or before it, as a fraction of
the body's size."""

SLACK = 1.5
"""A point of the skin has data if it is within this many spacings of the data."""

HIDDEN = 0.03
"""A point of the skin this far behind the measured depth is hidden [m]."""


@dataclass(frozen=True)
class Measured:
    """The data of one frame.

    Attributes:
        observation: The observation.
        points: All its points: of a depth image every measured pixel, (N, 3) [m].
        camera: The camera of a depth image; None of a cloud.
        share: The part of all compared points that are this frame's.
    """

    observation: Observation
    points: Array
    camera: Camera | None
    share: float = 1.0

    @classmethod
    def of(cls, observation: Observation, share: float = 1.0) -> Measured:
        """Returns the data of an observation by one camera, or without one."""
        camera, depth = observation.camera, observation.depth
        if camera is None or depth is None:
            return cls(observation, observation.points, None, share)
        return cls(observation, camera.back_projected(depth), camera, share)

    @cached_property
    def chosen(self) -> Array:
        """The points that are compared with the skin, (M, 3) [m]."""
        count, most = len(self.points), round(self.share * MOST_POINTS)
        if count <= most:
            return self.points
        # Pixels and scanned points come in rows; a part of a random order is even.
        return self.points[np.random.default_rng(0).permutation(count)[:most]]

    @cached_property
    def tree(self) -> scipy.spatial.KDTree:
        """All points."""
        return scipy.spatial.KDTree(self.points)

    @cached_property
    def outline(self) -> Outline | None:
        """The outline of the data in the picture; None without a camera."""
        if self.camera is None or self.observation.depth is None:
            return None
        most = round(self.share * MOST_OUTLINE_POINTS)
        return Outline.of(self.camera, self.observation.depth, most)

    @cached_property
    def spacing(self) -> float:
        """Distance between neighbouring points [m]."""
        gaps = np.asarray(self.tree.query(self.chosen, k=2)[0])
        return float(np.median(gaps[:, 1]))

    def distances(
        self, skin: SkinPoints, vertices: Array, size: float
    ) -> tuple[SkinDistances, SkinDistances, SkinDistances]:
        """Returns the distances of the data to the skin, of the skin to the data, and of outlines.

        Args:
            skin: Points on the skin.
            vertices: The skin's vertices in the world, (V, 3) [m].
            size: The body's size [m].
        """
        placed, normals = skin.place(vertices), skin.normals(vertices)
        shown = np.ones(len(placed), dtype=bool)
        if self.camera is not None:
            shown = np.einsum("qi,qi->q", placed, normals) < 0.0
        to_skin = self._to_skin(skin, placed, normals, np.flatnonzero(shown), size)
        to_data = self._to_data(skin, placed, shown)
        if self.outline is None:
            return to_skin, to_data, SkinDistances.none()
        return to_skin, to_data, self.outline.distances(skin, placed, normals, size)

    def _to_skin(
        self, skin: SkinPoints, placed: Array, normals: Array, shown: Indices, size: float
    ) -> SkinDistances:
        """Returns the distance of each chosen point to the tangent plane where it meets the skin.

        A pixel meets the skin on its ray, so that noise along the ray does not bias where. One
        beside the skin, or a point without a camera, meets the nearest point; beside the skin the
        distance is to that point itself.
        """
        data = self.chosen
        nearest = shown[scipy.spatial.cKDTree(placed[shown]).query(data)[1]]
        beside = np.zeros(len(data), dtype=bool)
        if self.camera is not None:
            rays, own = _pixels(self.camera, placed[shown]), _pixels(self.camera, data)
            found = scipy.spatial.cKDTree(rays).query(own, k=min(NEIGHBOURS, len(shown)))
            gaps, near = (np.asarray(one).reshape(len(data), -1) for one in found)
            depths = np.abs(placed[shown[near], 2] - data[:, 2:])
            best = np.arange(len(data)), depths.argmin(axis=1)
            spacing = BESIDE * float(np.median(gaps[:, 0]) + 1.0)
            met = (gaps[best] < spacing) & (depths[best] < FAR * size)
            nearest = np.where(met, shown[near[best]], nearest)
            beside = ~met
        offsets = data - placed[nearest]
        directions = normals[nearest]
        straight = np.linalg.norm(offsets, axis=1)
        ways = offsets / np.maximum(straight, 1e-9)[:, None]
        directions = np.where(beside[:, None], ways, directions)
        return SkinDistances(
            lengths=(offsets * directions).sum(axis=1),
            directions=directions,
            corners=skin.corners[nearest],
            shares=skin.shares[nearest],
        )

    def _to_data(self, skin: SkinPoints, placed: Array, shown: NDArray[np.bool_]) -> SkinDistances:
        """Returns the distances of points of the skin to the data, beyond their spacing.

        Only those count that the data would show.
        """
        most = min(round(self.share * MOST_SKIN_POINTS), len(placed))
        chosen = np.linspace(0, len(placed) - 1, most).astype(np.intp)
        chosen = chosen[shown[chosen]]
        sight = self.observation.sight
        if sight is not None:
            chosen = chosen[sight.observable(placed[chosen], HIDDEN)]
        gaps, nearest = self.tree.query(placed[chosen])
        offsets = self.points[nearest] - placed[chosen]
        return SkinDistances(
            lengths=np.maximum(gaps - SLACK * self.spacing, 0.0),
            directions=offsets / np.maximum(gaps, 1e-9)[:, None],
            corners=skin.corners[chosen],
            shares=skin.shares[chosen],
        )


def _pixels(camera: Camera, points: Array) -> Array:
    """Returns the pixels (N, 2) of points (N, 3) before the camera."""
    depth = np.maximum(points[:, 2], 1e-3)
    return np.column_stack([
        camera.fx * points[:, 0] / depth + camera.cx, camera.fy * points[:, 1] / depth + camera.cy
    ])  # fmt: skip
