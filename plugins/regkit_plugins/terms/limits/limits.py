"""Limits: penalises violations of joint limits."""

from __future__ import annotations

from dataclasses import dataclass
from math import radians
from typing import Literal

import numpy as np

from regkit.body import Body
from regkit.config.quantities import Length, Spread, Weight
from regkit.interfaces import CompiledJoints, JointEnergy, JointResponse, Scene, Term
from regkit.primitives import Primitives
from regkit.skeleton import Pose, Skeleton
from regkit.system.arrays import Array
from regkit_plugins.terms.limits.compiled import respond_joints


class LimitsTerm(Term):
    """Half the squared violation of every joint limit: hinges, swings and twists.

    Use it with solvers that do not enforce the limits of ball joints, such as ``lbfgs``.
    """

    kind: Literal["limits"] = "limits"

    weight: Weight = 0.1
    """Weight relative to the kernel's energy."""
    tolerance_deg: Spread = 10.0
    """Violation whose energy is half the weight [deg]."""
    tolerance: Length = 0.02
    """The same for prismatic joints [m]."""

    def bind(self, scene: Scene) -> BoundLimits:
        """Binds the term to the limits of the body."""
        bones = scene.body.skeleton
        of_balls = np.full(2 * len(bones.ball_links), self._of_angles)
        return BoundLimits(bones, np.concatenate([of_balls, self._of_hinges(bones)]))

    def compiled(self, body: Body, primitives: Primitives) -> CompiledJoints:
        """Returns the term as a compiled function."""
        hinges = self._of_hinges(body.skeleton)
        return CompiledJoints(respond_joints, (self._of_angles,), table=hinges[:, None])

    @property
    def _of_angles(self) -> float:
        """Weight of half the squared violation of an angle [1/rad^2]."""
        return self.weight / radians(self.tolerance_deg) ** 2

    def _of_hinges(self, skeleton: Skeleton) -> Array:
        """Returns the weight of each hinge, (n_hinge,) [1/rad^2 or 1/m^2]."""
        prismatic = self.weight / self.tolerance**2
        return np.where(skeleton.limits.prismatic, prismatic, self._of_angles)


@dataclass(frozen=True)
class BoundLimits(JointEnergy):
    """``1/2 sum w v^2`` over all violations v.

    Attributes:
        skeleton: The skeleton.
        weights: Weights w of all twists, swings and hinges, (2 n_ball + n_hinge,) [1/rad^2 or
            1/m^2].
    """

    skeleton: Skeleton
    weights: Array

    def __call__(self, pose: Pose) -> JointResponse:
        """Returns the energy, its exact gradient, and its Gauss-Newton matrix."""
        violations, jacobian = self.skeleton.violations(pose)
        pulls = self.weights * violations
        return JointResponse(
            0.5 * float(pulls @ violations),
            pulls @ jacobian,
            jacobian.T @ (self.weights[:, None] * jacobian),
        )
