"""Motion prior: what the frames before tell of a pose."""

from __future__ import annotations

from dataclasses import dataclass
from typing import ClassVar, Literal

import numpy as np

from regkit.body import Body
from regkit.config.quantities import Length, Spread, Weight
from regkit.geometry.rotation import right_jacobian
from regkit.interfaces import CompiledJoints, JointEnergy, JointResponse, Prior, Scene, Term
from regkit.primitives import Primitives
from regkit.skeleton import Pose, Skeleton
from regkit.system.arrays import Array
from regkit_plugins.terms.motion_prior.compiled import respond_joints


class MotionPrior(Term):
    """Half the squared Mahalanobis distance to the prior, per effective point.

    With the tracker `filter` it carries what earlier frames have shown, and how surely. Other
    trackers know a pose alone; then it keeps the joints near it, as `continuity` does.
    """

    kind: Literal["motion_prior"] = "motion_prior"
    informed: ClassVar[bool] = True

    weight: Weight = 0.01
    """Weight of a prior that is a pose alone, relative to the kernel's energy."""
    joint_deg: Spread = 20.0
    """Typical rotation of a joint away from a prior that is a pose alone [deg]."""
    displacement: Length = 0.05
    """Typical displacement of a prismatic joint away from such a prior [m]."""

    def bind(self, scene: Scene) -> BoundMotionPrior:
        """Binds the term to the prior."""
        skeleton, prior = scene.body.skeleton, scene.prior
        stiffness = prior.stiffness
        if stiffness is None:
            stiffness = self._usual(skeleton)
        return BoundMotionPrior(skeleton, prior, stiffness)

    def compiled(self, body: Body, primitives: Primitives) -> CompiledJoints:
        """Returns the term as a compiled function."""
        return CompiledJoints(respond_joints, table=self._usual(body.skeleton))

    def _usual(self, skeleton: Skeleton) -> Array:
        """Returns the stiffness (n, n) of a prior that is a pose alone; free joints are."""
        usual = np.full(skeleton.dofs, np.radians(self.joint_deg))
        usual[skeleton.hinge_dofs][skeleton.limits.prismatic] = self.displacement
        stiffness = self.weight / usual**2
        stiffness[skeleton.free_dofs] = 0.0
        return np.diag(stiffness)


@dataclass(frozen=True)
class BoundMotionPrior(JointEnergy):
    """``1/2 d^T L d`` with the step d of the degrees of freedom from the prior's pose.

    Attributes:
        skeleton: The skeleton.
        prior: The prior.
        stiffness: L, its information per effective point, (n, n).
    """

    skeleton: Skeleton
    prior: Prior
    stiffness: Array

    def __call__(self, pose: Pose) -> JointResponse:
        """Returns the energy, its exact gradient, and L as its stiffness."""
        skeleton = self.skeleton
        step = skeleton.difference(self.prior.pose, pose)
        pull = self.stiffness @ step
        energy = 0.5 * float(step @ pull)
        turning = slice(3 if skeleton.free else 0, skeleton.hinge_dofs.start)
        turns = step[turning].reshape(-1, 3)
        # The step follows a rotation of its end by the inverse right Jacobian.
        inverse = np.linalg.inv(right_jacobian(turns))
        force = pull.copy()
        force[turning] = np.einsum("bji,bj->bi", inverse, pull[turning].reshape(-1, 3)).ravel()
        return JointResponse(energy, force, self.stiffness)
