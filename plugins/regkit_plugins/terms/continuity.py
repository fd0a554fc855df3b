"""Continuity: a pose stays near the one that is expected."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Annotated, Literal

import numpy as np
from pydantic import Field

from regkit.body import Body
from regkit.interfaces import JointEnergy, JointResponse, Scene, Term
from regkit.skeleton import Pose, Skeleton
from regkit.skeleton.compiled_steps import ball_steps
from regkit.system.arrays import Array


class Continuity(Term):
    """Half the squared way from the expected pose, as rotation vectors, in units of ``joint_deg``.

    The root is left free, for it is always seen; what the data say nothing about stays as expected.
    """

    kind: Literal["continuity"] = "continuity"

    weight: Annotated[float, Field(gt=0.0)] = 0.01
    """Weight against the kernel's energy."""
    joint_deg: Annotated[float, Field(gt=0.0)] = 20.0
    """How far a joint turns from frame to frame [deg]."""
    joints_deg: dict[str, Annotated[float, Field(gt=0.0)]] = Field(default_factory=dict)
    """The same of single joints, by segment [deg]."""

    def check(self, body: Body) -> None:
        """Every joint that is named must be there.

        Raises:
            ConfigError: If ``joints_deg`` names a joint that there is not.
        """
        for name in self.joints_deg:
            body.skeleton.dofs_of(name)

    def bind(self, scene: Scene) -> BoundContinuity:
        """Bind the term to the pose that is expected."""
        skeleton = scene.body.skeleton
        usual = np.full(skeleton.dofs, self.joint_deg)
        for name, degrees in self.joints_deg.items():
            usual[skeleton.dofs_of(name)] = degrees
        weights = self.weight / np.radians(usual) ** 2
        weights[: skeleton.ball_dofs.start] = 0.0
        return BoundContinuity(skeleton, scene.prior, weights, np.diag(weights))


@dataclass(frozen=True)
class BoundContinuity(JointEnergy):
    """``1/2 sum w r^2`` with the step r of the joints from the expected pose.

    Attributes:
        skeleton: Whose poses.
        expected: The pose that costs nothing.
        weights: w, (n,), equal for the three numbers of a ball joint, and zero for the root.
        stiffness: The same as a matrix, (n, n).
    """

    skeleton: Skeleton
    expected: Pose
    weights: Array
    stiffness: Array

    def __call__(self, pose: Pose) -> JointResponse:
        """The force is w r itself: a rotation vector is the same before and after its rotation."""
        step = np.zeros(self.skeleton.dofs)
        step[self.skeleton.ball_dofs] = ball_steps(self.expected.balls, pose.balls).ravel()
        step[self.skeleton.hinge_dofs] = pose.hinges - self.expected.hinges
        force = self.weights * step
        return JointResponse(0.5 * float(force @ step), force, self.stiffness)
