"""Limits: penalises violations of joint limits."""

from __future__ import annotations

from dataclasses import dataclass
from math import radians
from typing import Literal

from regkit.body import Body
from regkit.config.quantities import Spread, Weight
from regkit.interfaces import CompiledJoints, JointEnergy, JointResponse, Scene, Term
from regkit.primitives import Primitives
from regkit.skeleton import Pose, Skeleton
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

    def bind(self, scene: Scene) -> BoundLimits:
        """Binds the term to the limits of the body."""
        return BoundLimits(scene.body.skeleton, self._stiffness)

    def compiled(self, body: Body, primitives: Primitives) -> CompiledJoints:
        """Returns the term as a compiled function."""
        return CompiledJoints(respond_joints, (self._stiffness,))

    @property
    def _stiffness(self) -> float:
        """Weight of half the squared violation [1/rad^2]."""
        return self.weight / radians(self.tolerance_deg) ** 2


@dataclass(frozen=True)
class BoundLimits(JointEnergy):
    """``1/2 w sum v^2`` over all violations v.

    Attributes:
        skeleton: The skeleton.
        weight: Weight w [1/rad^2].
    """

    skeleton: Skeleton
    weight: float

    def __call__(self, pose: Pose) -> JointResponse:
        """Returns the energy, its exact gradient, and its Gauss-Newton matrix."""
        violations, jacobian = self.skeleton.violations(pose)
        force = self.weight * violations @ jacobian
        return JointResponse(
            0.5 * self.weight * float(violations @ violations),
            force,
            self.weight * jacobian.T @ jacobian,
        )
