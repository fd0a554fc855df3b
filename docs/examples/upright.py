"""A term of one's own: a body that keeps upright.

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
    """The energy bound to a frame."""

    weight: float
    dofs: int

    def __call__(self, pose: Pose) -> JointResponse:
        """The energy, its force on the root's rotation, and its Gauss-Newton matrix."""
        # A turn of the root by w in its own frame moves its y axis by R (w x y): w is (-z, 0, x).
        rotation = pose.root[:3, :3]
        sine = rotation[[0, 2], 1]
        slope = np.zeros((2, self.dofs))
        slope[:, 3] = rotation[[0, 2], 2]
        slope[:, 5] = -rotation[[0, 2], 0]
        force = self.weight * sine @ slope
        return JointResponse(
            0.5 * self.weight * float(sine @ sine), force, self.weight * slope.T @ slope
        )


@register
class Upright(Term):
    """Half the squared sine between the root's y axis and the image's upward direction."""

    kind: Literal["upright"] = "upright"

    weight: float = 0.1
    """Weight against the kernel's energy."""

    def bind(self, scene: Scene) -> Tilt:
        """Bind the term to the body; the frame does not matter."""
        return Tilt(self.weight, scene.body.skeleton.dofs)
