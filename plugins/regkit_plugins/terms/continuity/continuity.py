"""Continuity: keeps the pose close to the prior."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal

import numpy as np
from pydantic import Field

from regkit.body import Body
from regkit.config.quantities import Length, Spread, Weight
from regkit.interfaces import CompiledJoints, JointEnergy, JointResponse, Scene, Term
from regkit.primitives import Primitives
from regkit.skeleton import Pose, Skeleton
from regkit.skeleton.compiled_steps import ball_steps
from regkit.system.arrays import Array
from regkit_plugins.terms.continuity.compiled import respond_joints


class Continuity(Term):
    """Half the squared distance to the prior pose, as rotation vectors in units of ``joint_deg``.

    The root, which is always observed, is free, and so is that of each of several bodies. Joints
    that are not observed stay at the prior.
    """

    kind: Literal["continuity"] = "continuity"

    weight: Weight = 0.01
    """Weight relative to the kernel's energy."""
    joint_deg: Spread = 20.0
    """Typical rotation of a joint between frames [deg]."""
    joints_deg: dict[str, Spread] = Field(default_factory=dict)
    """Typical rotation of individual joints, by segment [deg]."""
    displacement: Length = 0.05
    """Typical displacement of a prismatic joint between frames [m]."""

    def check(self, body: Body) -> None:
        """Validates the names of joints.

        Raises:
            FieldError: If ``joints_deg`` names an unknown joint, or one that does not rotate.
        """
        for name in self.joints_deg:
            body.skeleton.rotating(name, "joints_deg")

    def bind(self, scene: Scene) -> BoundContinuity:
        """Binds the term to the prior pose."""
        weights = self._weights(scene.body.skeleton)
        return BoundContinuity(scene.body.skeleton, scene.prior.pose, weights, np.diag(weights))

    def compiled(self, body: Body, primitives: Primitives) -> CompiledJoints:
        """Returns the term as a compiled function."""
        return CompiledJoints(respond_joints, table=self._weights(body.skeleton)[:, None])

    def _weights(self, skeleton: Skeleton) -> Array:
        """Returns the weights (n,) of the squared steps; those of free joints are zero."""
        usual = np.full(skeleton.dofs, np.radians(self.joint_deg))
        for name, degrees in self.joints_deg.items():
            usual[skeleton.dofs_of(name)] = np.radians(degrees)
        usual[skeleton.hinge_dofs][skeleton.limits.prismatic] = self.displacement
        weights = self.weight / usual**2
        weights[skeleton.free_dofs] = 0.0
        return np.asarray(weights)


@dataclass(frozen=True)
class BoundContinuity(JointEnergy):
    """``1/2 sum w r^2`` with the step r of the joints from the prior pose.

    Attributes:
        skeleton: The skeleton.
        expected: The prior pose, with zero energy.
        weights: w, (n,), equal for the three components of a ball joint, and zero for free joints.
        stiffness: The diagonal matrix of the weights, (n, n).
    """

    skeleton: Skeleton
    expected: Pose
    weights: Array
    stiffness: Array

    def __call__(self, pose: Pose) -> JointResponse:
        """Returns the energy, its gradient w r, and its stiffness.

        The gradient is exact, because a rotation leaves its own rotation vector unchanged.
        """
        step = np.zeros(self.skeleton.dofs)
        step[self.skeleton.ball_dofs] = ball_steps(self.expected.balls, pose.balls).ravel()
        step[self.skeleton.hinge_dofs] = pose.hinges - self.expected.hinges
        force = self.weights * step
        return JointResponse(0.5 * float(force @ step), force, self.stiffness)
