"""Recovery: noticing that limbs were lost, and finding them again."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Annotated

import numpy as np
from pydantic import Field
from scipy.spatial import KDTree

from regkit.config.model import Model
from regkit.interfaces import Evaluation, Past, Registrar, RegistrationResult
from regkit.observation import Observation
from regkit.search.limb_search import LimbSearch

BEST_SHARE = 0.25
"""The quarter of the frames with the most inliers says what is usual in a recording."""


class Recovery(Model):
    """Tries other configurations of each limb, and keeps one that fits the frame better.

    It searches for lost limbs when a frame has more outliers than is usual in the recording. Of
    many configurations within the joint limits, it registers the few that best cover the points
    that the rest of the body leaves over.
    """

    samples: Annotated[int, Field(ge=2)] = 500
    """Configurations drawn for each limb."""
    starts: Annotated[int, Field(ge=1)] = 2
    """How many of these are registered."""
    gain: Annotated[float, Field(ge=0.0, lt=1.0)] = 0.01
    """A limb may only jump if the mean inlier probability rises by more than this."""
    alarm: Annotated[float, Field(ge=1.0)] = 1.3
    """Search when the share of outliers exceeds this many times the usual share, plus ``gain``."""
    every: Annotated[int, Field(ge=1)] = 20
    """Search in the first frame, and then every so many frames in any case."""

    def bind(self, registrar: Registrar) -> BoundRecovery:
        """Draw the configurations, which are the same in all frames."""
        random = np.random.default_rng(0)
        searches = LimbSearch.of_all(registrar.body, random, self.samples)
        return BoundRecovery(self, registrar, tuple(searches))


@dataclass(frozen=True)
class BoundRecovery:
    """``Recovery`` for one registrar.

    Attributes:
        recovery: Its configuration.
        registrar: What registers a frame.
        searches: One for each limb.
    """

    recovery: Recovery
    registrar: Registrar
    searches: tuple[LimbSearch, ...]

    def checked(
        self,
        observation: Observation,
        found: RegistrationResult,
        past: Past,
    ) -> RegistrationResult:
        """What was found, or a better registration with a limb in another place."""
        if not self._alarmed(found, past):
            return found
        return self.recovered(observation, found)

    def recovered(self, observation: Observation, found: RegistrationResult) -> RegistrationResult:
        """The best of what was found and of what the searches lead to, limb after limb."""
        best, evaluation = found, self.registrar.evaluate(observation, found.pose)
        cloud = KDTree(observation.points)
        for search in self.searches:
            for start in search.starts(cloud, best.pose, self.recovery.starts):
                tried = self.registrar.register(observation, [start])
                rival = self.registrar.evaluate(observation, tried.pose)
                if self._better(rival, evaluation):
                    best, evaluation = tried, rival
        return best

    def _better(self, new: Evaluation, old: Evaluation) -> bool:
        gain = float((new.inlier_probability - old.inlier_probability).mean())
        return new.energy < old.energy and gain > self.recovery.gain

    def _alarmed(self, found: RegistrationResult, past: Past) -> bool:
        """Whether there are more outliers than usual, or it is time to search anyway."""
        if past.frames % self.recovery.every == 0:
            return True
        usual = float(np.quantile(1.0 - np.array(past.inlier_shares), BEST_SHARE))
        # What no jump could gain is no reason to search for one.
        return 1.0 - found.inlier_share > self.recovery.alarm * usual + self.recovery.gain
