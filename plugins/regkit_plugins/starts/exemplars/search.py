"""The search of one template: exemplars become finalists, in one size or over all of them."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property

import numpy as np

from regkit.body import Body
from regkit.interfaces import Template
from regkit.observation import Observation
from regkit.search.exemplars import Atlas, Exemplar, Finder, Pictures
from regkit.start import Candidate, Finalist, Scan
from regkit.start.sizes import fit, resized
from regkit.system.arrays import Array
from regkit_plugins.starts.exemplars.finalists import Comparison

MORE = 2
"""Factor of the numbers of exemplars that are looked up and refined over all sizes together."""

PER_SIZE = 2
"""Least number of finalists of each candidate size."""


@dataclass(frozen=True)
class Search:
    """Seeks a template in frames.

    Attributes:
        template: The template.
        atlas: Its atlas.
        comparison: Registers the finalists.
        rolls: Rolls that are tried, (R,) [rad].
        looked_up: Number of similar exemplars that are rendered.
        refined: Number of these that are refined.
        finalists: Number of refined poses that are registered.
    """

    template: Template
    atlas: Atlas
    comparison: Comparison
    rolls: Array
    looked_up: int
    refined: int
    finalists: int

    def sized(self, body: Body, observation: Observation) -> list[Finalist]:
        """Returns the finalists of a body of known size, the best first."""
        return self._finalists([body], observation, self.finalists)

    def unsized(self, observations: Sequence[Observation]) -> list[Finalist]:
        """Returns the finalists in the first frame, the best first, all of the size that fits best.

        The frame that fits best determines the size: a person who sits or folds the arms reveals it
        less well.
        """
        bodies = [self.template.body(size) for size in self._sizes]
        each = max(PER_SIZE, self.finalists // len(bodies))
        found = [self._finalists(bodies, one, each) for one in observations]
        telling = int(np.argmin([finalists[0].misfit for finalists in found]))
        best = self._resized(observations[telling], found[telling])
        rivals = self.sized(best.body, observations[0])
        return sorted([best, *rivals] if telling == 0 else rivals, key=_cost)

    @property
    def _sizes(self) -> tuple[float, ...]:
        return self.template.candidate_sizes()

    @cached_property
    def _usual(self) -> float:
        return self._sizes[len(self._sizes) // 2]

    def _finalists(
        self, bodies: Sequence[Body], observation: Observation, each: int
    ) -> list[Finalist]:
        """Returns the registered poses, the best first.

        Args:
            bodies: The body in one or more sizes.
            observation: The frame.
            each: Number of finalists of each size.
        """
        pictures, scan = Pictures.of(observation, self._usual), Scan(observation.points)
        # A size between the candidates resembles fewer exemplars.
        more = 1 if len(bodies) == 1 else MORE
        finder = Finder(bodies, self.atlas, self.rolls, more * self.looked_up, more * self.refined)
        candidates = finder.candidates(pictures)
        chosen: list[Exemplar] = []
        for body in bodies:
            chosen += [one for one in candidates if one.body is body][:each]
        finalists = [
            self.comparison.finalist(one.body, one.pose, observation, scan) for one in chosen
        ]
        return sorted(finalists, key=_cost)

    def _resized(self, observation: Observation, finalists: Sequence[Finalist]) -> Finalist:
        """Returns the best pose in sizes between the candidates.

        Args:
            observation: The frame.
            finalists: Finalists of all sizes, the best first.
        """
        scan = Scan(observation.points)
        bests = {one.body.size: one for one in reversed(finalists)}
        fits = [fit(scan, one.body, one.pose, self._usual) for one in bests.values()]
        best = resized(scan, self.template, min(fits, key=_misfit), self._sizes)
        return self.comparison.finalist(best.body, best.pose, observation, scan)


def _misfit(candidate: Candidate) -> float:
    return candidate.misfit


def _cost(finalist: Finalist) -> float:
    return finalist.cost
