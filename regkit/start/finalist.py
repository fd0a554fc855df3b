"""Finalists: poses that are registered by a method, with a search of their limbs, and compared."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from regkit.body import Body, BodyFit
from regkit.interfaces import RegistrationResult
from regkit.observation import Observation
from regkit.search.limb_recovery import LimbRecovery
from regkit.skeleton import Pose
from regkit.system.arrays import Array


@dataclass(frozen=True)
class Finalist:
    """A registered pose.

    Attributes:
        body: The body at a size.
        result: Its registration.
        energy: Energy of its pose, bound to the frame at this pose, in the method's own units.
        misfit: Its two-sided misfit, of the visible body alone, and what an unusual size adds,
            dimensionless.
        prior: Cost of the pose without regard to the data, dimensionless.
        disagreement: Cost of the rendered body's disagreement with the picture, dimensionless; zero
            if it was not rendered.
    """

    body: Body
    result: RegistrationResult
    energy: float
    misfit: float
    prior: float = 0.0
    disagreement: float = 0.0

    @classmethod
    def of(
        cls, limbs: LimbRecovery, pose: Pose, observation: Observation, usual: float
    ) -> Finalist:
        """Returns a pose after registration and a search of all limbs.

        Args:
            limbs: The search of the limbs, with the registrar.
            pose: The pose.
            observation: The frame.
            usual: The template's usual size [m].
        """
        found = limbs.registrar.register(observation, [pose])
        found = limbs.recovered(observation, found)
        return cls.registered(limbs, found, observation, usual)

    @classmethod
    def registered(
        cls,
        limbs: LimbRecovery,
        found: RegistrationResult,
        observation: Observation,
        usual: float,
    ) -> Finalist:
        """Returns what was registered as it is; the arguments are those of ``of``."""
        body = limbs.registrar.body
        energy = limbs.registrar.evaluate(observation, found.pose).energy
        fit = BodyFit.of(body, found.pose, observation.points, observation.sight)
        unusual = float(np.log(body.size / usual) ** 2)
        return cls(body, found, energy, fit.misfit + unusual)

    def moved(self, T_new_world: Array) -> Finalist:
        """Returns the same pose in another world.

        Args:
            T_new_world: Pose of the world in the new one, (4, 4) [m].
        """
        return replace(self, result=replace(self.result, pose=self.pose.moved(T_new_world)))

    @property
    def pose(self) -> Pose:
        """The registered pose."""
        return self.result.pose

    @property
    def cost(self) -> float:
        """Energy, misfit, prior and disagreement; lower is better."""
        return self.energy + self.misfit + self.prior + self.disagreement
