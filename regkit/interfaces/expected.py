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

FASTEST = 0.25
"""A part that moves farther between two frames has not moved but was corrected [size]: at 30 frames
per second, an arm of a person would have 13 m/s."""


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

    def within(self, points: Array, distance: float) -> NDArray[np.bool_]:
        """Returns a mask (N,) of the points (N, 3) [m] where the body may be.

        Each part reaches as far as ``distance`` [m], and as it moved between the last two frames. A
        hidden limb, whose pose may jump, so widens nothing but its own reach.
        """
        shape = self._reaching
        reach = distance if isinstance(shape, Capsules) else distance + self._motion.max()
        # Most points of a scene are far from the body, which its box tells faster.
        low, high = self._box
        near = np.asarray(((points >= low - reach) & (points <= high + reach)).all(axis=1))
        inside = np.flatnonzero(near)
        if isinstance(shape, Capsules):
            near[inside] = shape.surface_distance(points[inside]) <= reach
        else:
            near[inside] = shape.query(points[inside])[0] <= reach
        return near

    @cached_property
    def _reaching(self) -> Capsules | scipy.spatial.KDTree:
        """The placed capsules, as much thicker as each moved; or points of a body without them."""
        if not len(self.body.capsules):
            return scipy.spatial.KDTree(self._points(self.pose))
        placed = self.body.capsules.place(self.body.place(self.pose).transforms)
        motion = self._motion.reshape(len(placed), AXIS_SAMPLES).max(axis=1)
        return replace(placed, radii=placed.radii + motion[:, None])

    @cached_property
    def _box(self) -> tuple[Array, Array]:
        """Least and largest coordinates (3,) of the body [m]."""
        shape, points = self._reaching, self._points(self.pose)
        radius = shape.radii.max() if isinstance(shape, Capsules) else 0.0
        return points.min(axis=0) - radius, points.max(axis=0) + radius

    @cached_property
    def _motion(self) -> Array:
        """Displacement of each point that spans the body between the last two frames, (N,) [m]."""
        points = self._points(self.pose)
        if self.before is None:
            return np.zeros(len(points))
        motion = np.linalg.norm(points - self._points(self.before), axis=1)
        # What jumped was corrected, and may be back in the next frame as well as go on.
        return np.where(motion > FASTEST * self.body.size, 0.0, motion)

    def _points(self, pose: Pose) -> Array:
        """Returns points (N, 3) [m] that span the body in a pose."""
        transforms = self.body.place(pose).transforms
        if len(self.body.capsules):
            return self.body.capsules.axis_samples(AXIS_SAMPLES).place(transforms)
        if self.body.surface is not None:
            return self.body.surface.place(transforms)
        return np.asarray(transforms[:, :3, 3])
