"""Poses of a body with parts and of its base, which has rigid segments in their place."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Self

import numpy as np

from regkit.body.body import Body
from regkit.skeleton import Pose
from regkit.system.arrays import Indices
from regkit.system.brief import Brief


@dataclass(frozen=True)
class Lifting(Brief):
    """The joints that a body with parts and its base have in common.

    Attributes:
        base: The base.
        balls: Index of each ball joint of the base among those of the whole.
        hinges: Index of each hinge of the base among those of the whole.
        dofs: Index of each degree of freedom of the base among those of the whole.
    """

    base: Body
    balls: Indices
    hinges: Indices
    dofs: Indices

    @classmethod
    def of(cls, whole: Body) -> Self | None:
        """Returns the joints that a body and its base have in common; None without a base."""
        if whole.base is None:
            return None
        bones, base = whole.skeleton, whole.base.skeleton
        balls = [bones.ball_names.index(name) for name in base.ball_names]
        hinges = [bones.hinge_names.index(name) for name in base.hinge_names]
        of_balls = bones.ball_dofs.start + 3 * np.repeat(balls, 3) + np.tile([0, 1, 2], len(balls))
        dofs = [
            np.arange(base.ball_dofs.start),
            of_balls,
            bones.hinge_dofs.start + np.array(hinges, dtype=np.intp),
        ]
        return cls(
            whole.base,
            np.array(balls, dtype=np.intp),
            np.array(hinges, dtype=np.intp),
            np.concatenate(dofs).astype(np.intp),
        )

    def lowered(self, pose: Pose) -> Pose:
        """Returns the base's pose in a pose of the whole."""
        return Pose(pose.root, pose.balls[self.balls], pose.hinges[self.hinges])

    def lifted(self, pose: Pose, like: Pose) -> Pose:
        """Returns the pose of the whole whose base has a pose, and whose parts are as in another.

        Args:
            pose: The base's pose.
            like: A pose of the whole, which gives the joints of the parts.
        """
        balls, hinges = like.balls.copy(), like.hinges.copy()
        balls[self.balls], hinges[self.hinges] = pose.balls, pose.hinges
        return Pose(pose.root, balls, hinges)
