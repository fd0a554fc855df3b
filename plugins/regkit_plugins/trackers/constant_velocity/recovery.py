"""Recovery: noticing that limbs were lost, and finding them again."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Annotated

import numpy as np
from pydantic import Field
from scipy.spatial import KDTree

from regkit.config.model import Model
from regkit.interfaces import Fit, Registered, Registrar
from regkit.observation import Observation
from regkit.search.limb_search import LimbSearch

BEST_SHARE = 0.25
"""The quarter of the frames that were explained best tells what is usual in a sequence."""


class Recovery(Model):
    """Tries other configurations of each limb, and keeps one where it explains the frame better.

    It looks for lost limbs when more of a frame is left unexplained than is usual in the sequence.
    Of many configurations within the joint limits, the few that cover best what the rest of the
    body does not explain are registered.
    """

    samples: Annotated[int, Field(ge=2)] = 500
    """Configurations drawn for each limb."""
    starts: Annotated[int, Field(ge=1)] = 2
    """How many of these are registered."""
    gain: Annotated[float, Field(ge=0.0, lt=1.0)] = 0.01
    """A limb may only jump if that explains so much more of the data."""
    alarm: Annotated[float, Field(ge=1.0)] = 1.3
    """Look for lost limbs when so many times the usual share of the data is unexplained, and
    ``gain`` more."""
    every: Annotated[int, Field(ge=1)] = 20
    """Look for them in the first frame, and then after so many frames in any case."""

    def prepare(self, registrar: Registrar) -> Rescuer:
        """Draw the configurations, which are the same in all frames."""
        random = np.random.default_rng(0)
        searches = LimbSearch.of_all(registrar.body, random, self.samples)
        return Rescuer(self, registrar, tuple(searches))


@dataclass(frozen=True)
class Rescuer:
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
        self, observation: Observation, found: Registered, past: Sequence[Registered]
    ) -> Registered:
        """What was found, or a better registration with a limb in another place."""
        if not self._alarmed(found, past):
            return found
        return self.recovered(observation, found)

    def recovered(self, observation: Observation, found: Registered) -> Registered:
        """The best of what was found and of what the searches lead to, limb after limb."""
        best, fit = found, self.registrar.fit(observation, found.pose)
        cloud = KDTree(observation.points)
        for search in self.searches:
            for start in search.starts(cloud, best.pose, self.recovery.starts):
                tried = self.registrar.register(observation, start)
                its_fit = self.registrar.fit(observation, tried.pose)
                if self._better(its_fit, fit):
                    best, fit = tried, its_fit
        return best

    def _better(self, new: Fit, old: Fit) -> bool:
        gain = float((new.explained - old.explained).mean())
        return new.energy < old.energy and gain > self.recovery.gain

    def _alarmed(self, found: Registered, past: Sequence[Registered]) -> bool:
        """Whether more is unexplained than usual, or it is time to look anyway."""
        if (len(past) - 1) % self.recovery.every == 0:
            return True
        usual = float(np.quantile([1.0 - frame.explained for frame in past[1:]], BEST_SHARE))
        # What no jump could gain is no reason to look for one.
        return 1.0 - found.explained > self.recovery.alarm * usual + self.recovery.gain
