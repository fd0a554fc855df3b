"""Recovery of lost limbs: other configurations of each limb, registered and compared."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from regkit.interfaces import Evaluation, Registrar, RegistrationResult
from regkit.observation import Observation
from regkit.search.limb_search import LimbSearch

SAMPLES, STARTS, GAIN = 500, 2, 0.01
"""Usual numbers of configurations per limb that are sampled and registered, and what one must
gain."""


@dataclass(frozen=True)
class LimbRecovery:
    """Seeks better configurations of the limbs of a registered body.

    Attributes:
        registrar: The registrar.
        searches: The search of each limb.
        starts: Number of configurations per limb that are registered.
        gain: Minimum increase of the mean inlier probability for accepting a configuration.
    """

    registrar: Registrar
    searches: tuple[LimbSearch, ...]
    starts: int
    gain: float

    @classmethod
    def of(
        cls,
        registrar: Registrar,
        samples: int = SAMPLES,
        starts: int = STARTS,
        gain: float = GAIN,
    ) -> LimbRecovery:
        """Samples the configurations, which are the same for all frames.

        Args:
            registrar: The registrar.
            samples: Number of sampled configurations per limb.
            starts: Number of these that are registered.
            gain: Minimum increase of the mean inlier probability.
        """
        random = np.random.default_rng(0)
        searches = tuple(LimbSearch.of_all(registrar.body, random, samples))
        return cls(registrar, searches, starts, gain)

    def recovered(self, observation: Observation, found: RegistrationResult) -> RegistrationResult:
        """Returns the best registration after searching all limbs in turn."""
        best, evaluation = found, None
        for search in self.searches:
            starts = search.starts(observation.points, best.pose, self.starts, observation.sight)
            for start in starts:
                if evaluation is None:
                    evaluation = self.registrar.evaluate(observation, best.pose)
                tried = self.registrar.register(observation, [start])
                rival = self.registrar.evaluate(observation, tried.pose)
                if self._better(rival, evaluation):
                    best, evaluation = tried, rival
        return best

    def _better(self, new: Evaluation, old: Evaluation) -> bool:
        gain = float((new.inlier_probability - old.inlier_probability).mean())
        return new.energy < old.energy and gain > self.gain
