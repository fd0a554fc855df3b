"""The result of registering one frame, for notebooks: arrays, a table and a picture."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import ArrayLike

from regkit.api.tables import Summary
from regkit.body import Body
from regkit.skeleton import Pose
from regkit.system.arrays import Array
from regkit.tracking import Verdict

if TYPE_CHECKING:
    from matplotlib.figure import Figure

    from regkit.api.tracking import Tracking
    from regkit.viewer.embedded import SceneView


@dataclass(frozen=True, repr=False)
class Registration(Summary):
    """A body's pose in one frame.

    Attributes:
        tracking: The same result as a recording of one frame.
    """

    tracking: Tracking

    @property
    def body(self) -> Body:
        """The body at its given or estimated size."""
        return self.tracking.body

    @property
    def size(self) -> float:
        """Size of the body [m]: its height, length, or another size that the template defines."""
        return self.body.size

    @property
    def pose(self) -> Pose:
        """The pose of root and joints."""
        return self.tracking.poses[0]

    @property
    def joint_names(self) -> tuple[str, ...]:
        """The names of the M markers."""
        return self.tracking.joint_names

    @property
    def markers(self) -> Array:
        """Positions of the markers in the camera's frame, (M, 3) [m]."""
        return np.asarray(self.tracking.markers[0])

    @property
    def deviations(self) -> Array | None:
        """Standard deviations of the markers along the camera's axes, (M, 3) [m]; None if unknown.

        Along an axis, a marker is within 1.64 of them in 9 of 10 cases.
        """
        found = self.tracking.deviations
        return None if found is None else np.asarray(found[0])

    @property
    def covariance(self) -> Array | None:
        """Covariance (n, n) of the step from the pose to the true one; None if unknown."""
        found = self.tracking.covariances
        return None if found is None else np.asarray(found[0])

    @property
    def segments(self) -> Array:
        """T_camera_segment of each segment, (S, 4, 4) [m]."""
        return np.asarray(self.tracking.segments[0])

    @property
    def points(self) -> Array:
        """Points of the frame, after preprocessing, (N, 3) [m]."""
        return self.tracking.snapshot(0).points

    @property
    def verdict(self) -> Verdict:
        """Whether the body was found in this frame: found, doubtful or lost."""
        return self.tracking.verdict

    @property
    def reason(self) -> str:
        """Why the body is doubtful or lost; empty if it was found."""
        return self.tracking.judged.reason

    @property
    def inlier_share(self) -> float:
        """Fraction of the points that lie on the body, from 0 to 1."""
        return float(self.tracking.inlier_shares[0])

    @property
    def coverage(self) -> float:
        """Fraction of the body that has data nearby, from 0 to 1."""
        return float(self.tracking.coverages[0])

    def error(self, truth: Mapping[str, ArrayLike] | ArrayLike) -> float:
        """Returns the mean distance [m] of the markers to reference joints.

        Args:
            truth: Positions (3,) [m] by name, or (M, 3) [m] of all markers; NaN for unseen joints.

        Raises:
            RegkitError: If they do not match the markers.
        """
        if isinstance(truth, Mapping):
            return self.tracking.error({name: np.asarray(at)[None] for name, at in truth.items()})
        return self.tracking.error(np.asarray(truth)[None])

    def plot(self) -> Figure:
        """Returns a figure of the frame from the front and from the side."""
        return self.tracking.plot()

    def view(self, *, height: int = 560) -> SceneView:
        """Returns a view of points and body: a notebook shows it inline.

        Args:
            height: Height in a notebook [px].
        """
        return self.tracking.view(height=height)

    def save(self, path: str | Path) -> None:
        """Writes the pose in the format of ``Tracking.save``, with T = 1."""
        self.tracking.save(path)

    def rows(self) -> dict[str, str]:
        """Returns the rows of a table: frame, method, body, surface distance and convergence."""
        converged = "yes" if self.tracking.track.converged[0] else "no"
        return {
            "frame": self.tracking.name,
            **self.tracking.summary(self.tracking.measure()),
            "converged": f"{converged}: {self.tracking.message(0)}",
            **self.tracking.warning(),
        }
