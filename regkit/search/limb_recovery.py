"""Recovery of lost limbs: other configurations of each limb, registered and compared."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from regkit.interfaces import Evaluation, Registrar, RegistrationResult
from regkit.observation import Observation
from regkit.search.landmark_fit import LandmarkFit
from regkit.search.landmark_starts import body_starts, contradicted_limbs, limb_starts
from regkit.search.limb_search import LimbSearch
from regkit.skeleton import Pose

SAMPLES, STARTS, GAIN = 500, 2, 0.01
"""Usual numbers of configurations per limb that are sampled and registered, and what one must
gain."""

FEWEST = 20
"""Fewest points beside a part of a body that tell of the part's limbs."""


@dataclass(frozen=True)
class LimbRecovery:
    """Seeks better configurations of the limbs of a registered body.

    Where most landmarks of a frame contradict the pose, those of the whole body are tried too.

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
        found = self.corrected(observation, found)
        contest = Contest(self.registrar, observation, found, self.gain)
        for search in self.searches:
            pose = contest.best.pose
            beside = search.beside(observation.points, pose)
            if isinstance(beside, np.ndarray) and beside.sum() < FEWEST:
                continue
            starts = search.starts(observation.points, pose, self.starts, observation.sight)
            contest.try_all(starts, beside)
        return contest.best

    def corrected(self, observation: Observation, found: RegistrationResult) -> RegistrationResult:
        """Returns the best registration after trying what the landmarks suggest, if there are some.

        A pose that agrees with them need not explain more points, but must not explain fewer.
        """
        fit = LandmarkFit.of(self.registrar.body, observation)
        if fit is None:
            return found
        contest = Contest(self.registrar, observation, found, -self.gain)
        contest.try_all(body_starts(fit, found.pose))
        for search in contradicted_limbs(fit, self.searches, contest.best.pose):
            contest.try_all(limb_starts(fit, search, contest.best.pose))
        return contest.best


class Contest:
    """Registers starts one by one, and keeps the best.

    Args:
        registrar: The registrar.
        observation: The frame's data.
        found: The registration so far.
        gain: Minimum increase of the mean inlier probability of the points that matter; a negative
            one is a loss.

    Attributes:
        best: The best registration so far.
    """

    def __init__(
        self,
        registrar: Registrar,
        observation: Observation,
        found: RegistrationResult,
        gain: float,
    ) -> None:
        self.best = found
        self._registrar, self._observation, self._gain = registrar, observation, gain
        self._evaluation: Evaluation | None = None

    def try_all(
        self, starts: Iterable[Pose], points: NDArray[np.bool_] | slice = slice(None)
    ) -> None:
        """Tries starts, one after the other.

        Args:
            starts: The starts.
            points: Mask of the points that matter, (N,): those beside a small part of the body; by
                default all.
        """
        for start in starts:
            self._try(start, points)

    def _try(self, start: Pose, points: NDArray[np.bool_] | slice) -> None:
        if self._evaluation is None:
            self._evaluation = self._registrar.evaluate(self._observation, self.best.pose)
        tried = self._registrar.register(self._observation, [start])
        rival, old = self._registrar.evaluate(self._observation, tried.pose), self._evaluation
        gains = rival.inlier_probability - old.inlier_probability
        # A method without inlier probabilities has a single NaN.
        gain = float((gains[points] if len(gains) > 1 else gains).mean())
        if rival.energy < old.energy and gain > self._gain:
            self.best, self._evaluation = tried, rival
