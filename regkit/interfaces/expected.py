"""What is known of the body before a frame: where it was in the last one."""

from __future__ import annotations

from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np
import scipy
from numpy.typing import NDArray

from regkit.body import Body
from regkit.geometry.capsules import Capsules
from regkit.interfaces.tracker import Past
from regkit.skeleton import Pose
from regkit.system.arrays import Array
from regkit.system.brief import Brief

AXIS_SAMPLES = 3
"""Number of points on each capsule's axis whose motion is measured."""


@dataclass(frozen=True)
class Expected(Brief):
    """The body in the last frame, or the start for the first one.

    Attributes:
        body: The body.
        pose: Its pose.
        before: Its pose in the frame before that; None if it is unknown.
        missed: Number of frames without data since then.
    """

    body: Body
    pose: Pose
    before: Pose | None = None
    missed: int = 0

    @classmethod
    def of(cls, body: Body, past: Past) -> Expected:
        """Returns what the past tells of a body."""
        before = None if past.before is None else past.before.pose
        return cls(body, past.last.pose, before, past.missed)

    def seen_from(self, T_camera_world: Array) -> Expected:
        """Returns the same in the frame of a camera.

        Args:
            T_camera_world: Inverse of the camera's pose, (4, 4) [m].
        """
        pose = self.pose.moved(T_camera_world)
        before = None if self.before is None else self.before.moved(T_camera_world)
        return replace(self, pose=pose, before=before)

    @cached_property
    def motion(self) -> float:
        """Largest displacement of a part between the last two frames [m]; zero if unknown."""
        if self.before is None:
            return 0.0
        steps = self._points(self.pose) - self._points(self.before)
        return float(np.linalg.norm(steps, axis=1).max())

    def within(self, points: Array, distance: float) -> NDArray[np.bool_]:
        """Returns a mask (N,) of the points (N, 3) [m] within a distance [m] of the body."""
        ends, radius = self._points(self.pose), 0.0
        if isinstance(self._shape, Capsules):
            radius = float(self._shape.radii.max())
        # Most points of a scene are far from the body, which its box tells faster.
        low, high = ends.min(axis=0) - radius - distance, ends.max(axis=0) + radius + distance
        near = np.asarray(((points >= low) & (points <= high)).all(axis=1))
        inside = np.flatnonzero(near)
        if isinstance(self._shape, Capsules):
            near[inside] = self._shape.surface_distance(points[inside]) <= distance
        else:
            near[inside] = self._shape.query(points[inside])[0] <= distance
        return near

    @cached_property
    def _shape(self) -> Capsules | scipy.spatial.KDTree:
        """The placed capsules, or the points of a body without capsules."""
        if len(self.body.capsules):
            return self.body.capsules.place(self.body.place(self.pose).transforms)
        return scipy.spatial.KDTree(self._points(self.pose))

    def _points(self, pose: Pose) -> Array:
        """Returns points (N, 3) [m] that span the body in a pose."""
        transforms = self.body.place(pose).transforms
        if len(self.body.capsules):
            return self.body.capsules.axis_samples(AXIS_SAMPLES).place(transforms)
        if self.body.surface is not None:
            return self.body.surface.place(transforms)
        return np.asarray(transforms[:, :3, 3])
