"""The energy of one frame: the kernel and all terms, bound to the data at one pose."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np

from regkit.body import Body
from regkit.interfaces import JointEnergy, Multipliers, Similarity
from regkit.primitives import Primitives
from regkit.registration import Coordinates, RegistrationProblem
from regkit.skeleton import Pose
from regkit.system.arrays import Array


@dataclass(frozen=True)
class FrameEnergy:
    """The kernel and all terms, bound to a frame.

    Attributes:
        body: The body.
        primitives: Primitives with their weights in this frame.
        kernel: The bound kernel.
        terms: The bound terms on primitives, by their places in the YAML.
        joints: The bound terms on joints.
    """

    body: Body
    primitives: Primitives
    kernel: Similarity
    terms: Mapping[str, Similarity]
    joints: tuple[JointEnergy, ...]

    def total(self, pose: Pose) -> float:
        """Returns the energy of the kernel and all terms in a pose."""
        placed = self.primitives.place(self.body.place(pose).transforms)
        energies = [one.energy(placed) for one in (self.kernel, *self.terms.values())]
        return sum(energies) + sum(joint(pose).energy for joint in self.joints)

    def inlier_probability(self, pose: Pose) -> Array:
        """Returns the inlier probability of each point in a pose, (N,); NaN if it is unknown."""
        placed = self.primitives.place(self.body.place(pose).transforms)
        probability = self.kernel.inlier_probability(placed)
        return np.array([np.nan]) if probability is None else probability

    def problem(
        self, coordinates: Coordinates, multipliers: Multipliers | None
    ) -> RegistrationProblem:
        """Returns the registration problem in given coordinates of the pose."""
        return RegistrationProblem(
            coordinates,
            self.primitives,
            {"kernel": self.kernel, **self.terms},
            self.joints,
            multipliers,
        )
