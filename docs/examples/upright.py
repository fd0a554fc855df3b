"""A custom term that keeps a body upright, readable and compiled.

See docs/how-to/term.md and docs/how-to/compiled.md.
"""

from dataclasses import dataclass
from typing import Literal

import numpy as np

from regkit.body import Body
from regkit.config.plugin import register
from regkit.interfaces import CompiledJoints, JointEnergy, JointResponse, Scene, Term
from regkit.interfaces.compiled import PriorArrays
from regkit.primitives import Primitives
from regkit.skeleton import Pose
from regkit.skeleton.arrays import PoseArrays, SkeletonArrays
from regkit.system.compiled import compiled
from regkit.system.machine_types import Matrix, Vector


@dataclass(frozen=True)
class Tilt(JointEnergy):
    """The energy of the tilt, bound to a body."""

    weight: float
    dofs: int

    def __call__(self, pose: Pose) -> JointResponse:
        """Returns the energy, its gradient, and its Gauss-Newton matrix."""
        # A rotation w of the root in its own frame changes its y axis by R (w x y), where
        # w x y = (-w_z, 0, w_x).
        rotation = pose.root[:3, :3]
        sine = rotation[[0, 2], 1]
        jacobian = np.zeros((2, self.dofs))
        jacobian[:, 3] = rotation[[0, 2], 2]
        jacobian[:, 5] = -rotation[[0, 2], 0]
        return JointResponse(
            0.5 * self.weight * float(sine @ sine),
            self.weight * sine @ jacobian,
            self.weight * jacobian.T @ jacobian,
        )


@compiled(python=False)
def tilt(
    skeleton: SkeletonArrays,
    prior: PriorArrays,
    pose: PoseArrays,
    numbers: Vector,
    table: Matrix,
    force: Vector,
    matrix: Matrix,
) -> float:
    """Returns the energy of ``Tilt`` and adds its derivatives."""
    energy, weight = 0.0, numbers[0]
    for i in (0, 2):
        sine, third, fifth = pose.root[i, 1], pose.root[i, 2], -pose.root[i, 0]
        energy += 0.5 * weight * sine * sine
        force[3] += weight * sine * third
        force[5] += weight * sine * fifth
        matrix[3, 3] += weight * third * third
        matrix[5, 5] += weight * fifth * fifth
        matrix[3, 5] += weight * third * fifth
        matrix[5, 3] += weight * third * fifth
    return energy


@register
class Upright(Term):
    """Half the squared sine between the root's y axis and the image's upward direction."""

    kind: Literal["upright"] = "upright"

    weight: float = 0.1
    """Weight relative to the kernel's energy."""

    def bind(self, scene: Scene) -> Tilt:
        """Binds the term to the body; it does not depend on the frame."""
        return Tilt(self.weight, scene.body.skeleton.dofs)

    def compiled(self, body: Body, primitives: Primitives) -> CompiledJoints:
        """Returns the same term as a compiled function."""
        return CompiledJoints(tilt, numbers=(self.weight,))
