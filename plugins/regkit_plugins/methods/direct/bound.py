"""What a method minimises in one frame: everything bound to the frame's data."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from regkit.body import Body
from regkit.interfaces import JointEnergy, Multipliers, Similarity
from regkit.primitives import Primitives
from regkit.registration.coordinates import Coordinates
from regkit.registration.problem import RegistrationProblem
from regkit.skeleton import Pose
from regkit.system.arrays import Array


@dataclass(frozen=True)
class Bound:
    """What is minimised in one frame.

    Attributes:
        primitives: With the weights that they have in this frame.
        similarities: The kernel, and the terms that look at primitives.
        joints: The terms that look at joints.
    """

    primitives: Primitives
    similarities: tuple[Similarity, ...]
    joints: tuple[JointEnergy, ...]

    def misfit(self, body: Body, pose: Pose) -> float:
        """The kernel's energy in a pose."""
        placed = self.primitives.place(body.place(pose).transforms)
        return self.similarities[0](placed).energy

    def explained(self, body: Body, pose: Pose) -> Array:
        """How far the kernel finds each point explained in a pose, (N,)."""
        explained = self.similarities[0].explained(
            self.primitives.place(body.place(pose).transforms)
        )
        return np.array([np.nan]) if explained is None else explained

    def problem(
        self, coordinates: Coordinates, multipliers: Multipliers | None
    ) -> RegistrationProblem:
        """The problem in some coordinates of the pose."""
        return RegistrationProblem(
            coordinates, self.primitives, self.similarities, self.joints, multipliers
        )
