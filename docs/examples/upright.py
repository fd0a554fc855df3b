"""A custom term that keeps a body upright.

See docs/how-to/term.md.
"""

from dataclasses import dataclass
from typing import Literal

import numpy as np

from regkit.config.plugin import register
from regkit.interfaces import JointEnergy, JointResponse, Scene, Term
from regkit.skeleton import Pose


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


@register
class Upright(Term):
    """Half the squared sine between the root's y axis and the image's upward direction."""

    kind: Literal["upright"] = "upright"

    weight: float = 0.1
    """Weight relative to the kernel's energy."""

    def bind(self, scene: Scene) -> Tilt:
        """Binds the term to the body; it does not depend on the frame."""
        return Tilt(self.weight, scene.body.skeleton.dofs)
