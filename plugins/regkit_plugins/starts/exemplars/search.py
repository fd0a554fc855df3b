"""The search of one template: exemplars become finalists, in one size or over all of them."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from functools import cached_property

import numpy as np

from regkit.body import Body
from regkit.interfaces import Template
from regkit.observation import Observation
from regkit.search.exemplars import BRIEF, THOROUGH, Atlas, Finder, Pictures, Variation
from regkit.start import Candidate, Finalist, Scan
from regkit.start.sizes import fit, resized
from regkit.system.arrays import Array
from regkit_plugins.starts.exemplars.contest import Contest, cost_of
from regkit_plugins.starts.exemplars.finalists import Comparison

MORE = 2
"""Factor of the numbers of exemplars that are looked up and refined over all sizes together, or in
a thorough search."""

CUT_REFINED = 8
"""Factor of the number of exemplars that are refined if the picture cuts the body off.

Of 40 bodies each of the development set of ``benchmarks/starts.py``, 95.0 % are right with 65 % in
view, and 87.5 % with 50 %; with a factor of 5 it is 95.0 and 85.0 %, with 2 92.5 and 77.5 %. Four
times as many exemplars to begin with change nothing.
"""

POOR = 0.45
"""A body of known size whose best pose has a larger misfit is sought again, more thoroughly.

Of folded people who are found, 2 % have a larger one (development set of ``benchmarks/starts.py``).
"""

PER_SIZE = 2
"""Number of finalists of each candidate size. With three of them, a person on a chair of UTD-MHAD
is 20 cm too tall: more poses explain the chair in a wrong size."""


@dataclass(frozen=True)
class Search:
    """Seeks a template in frames.

    Attributes:
        template: The template.
        atlas: Its atlas.
        cut_atlas: Function that returns the atlas of bodies that a picture shows in part.
        comparison: Registers the finalists.
        rolls: Rolls that are tried, (R,) [rad].
        looked_up: Number of similar exemplars that are rendered.
        refined: Number of these that are refined.
        finalists: Number of refined poses that are registered.
    """

    template: Template
    atlas: Atlas
    cut_atlas: Callable[[], Atlas]
    comparison: Comparison
    rolls: Array
    looked_up: int
    refined: int
    finalists: int

    def sized(self, body: Body, observation: Observation) -> list[Finalist]:
        """Returns the finalists of a body of known size, the best first."""
        found = self._finalists([body], observation, self.finalists)
        if found[0].misfit > POOR and not self._is_cut(observation):
            found += self._finalists([body], observation, self.finalists, THOROUGH)
        return sorted(found, key=cost_of)

    def unsized(self, observations: Sequence[Observation]) -> list[Finalist]:
        """Returns the finalists in the first frame, the best first, all of the size that fits best.

        The frame that fits best determines the size: a person who sits or folds the arms reveals it
        less well.
        """
        bodies = [self.template.body(size) for size in self._sizes]
        found = [self._finalists(bodies, one, PER_SIZE) for one in observations]
        telling = int(np.argmin([finalists[0].misfit for finalists in found]))
        best = self._resized(observations[telling], found[telling])
        rivals = self.sized(best.body, observations[0])
        return sorted([best, *rivals] if telling == 0 else rivals, key=cost_of)

    def doubts(self, body: Body, observation: Observation) -> list[str]:
        """Returns what speaks against a body of this size in a frame, whatever its pose."""
        doubts = []
        if len(self._sizes) > 1 and not self._sizes[0] < body.size < self._sizes[-1]:
            doubts.append(f"the size, {body.size:.3g} m, is at an end of the template's range")
        pictures = [Pictures.of(view.data, body.size) for view in observation.each_view]
        least = self.atlas.least_area() * body.size**2
        shares = [one.area / least for one in pictures if not one.cut]
        # What one camera hardly shows another may show well.
        share = max(shares, default=1.0)
        if share < 1.0:
            told = f"the data show {100.0 * share:.0f} % of the least area that such a body shows"
            doubts.append(told)
        return doubts

    @property
    def _sizes(self) -> tuple[float, ...]:
        return self.template.candidate_sizes()

    @cached_property
    def _usual(self) -> float:
        return self._sizes[len(self._sizes) // 2]

    def _finalists(
        self,
        bodies: Sequence[Body],
        observation: Observation,
        each: int,
        variation: Variation = BRIEF,
    ) -> list[Finalist]:
        """Returns the registered poses, the best first.

        Candidates are sought in the view of each camera, and registered to all of them.

        Args:
            bodies: The body in one or more sizes.
            observation: The frame.
            each: Number of finalists of each size, in each view.
            variation: How much refined poses are varied.
        """
        found: list[Finalist] = []
        for view in observation.each_view:
            local = observation.seen_from(view)
            own = self._in_view(bodies, local, view.data, each, variation)
            found += [one.moved(view.T_world_camera) for one in own] if observation.views else own
        return sorted(found, key=cost_of)

    def _in_view(
        self,
        bodies: Sequence[Body],
        observation: Observation,
        seen: Observation,
        each: int,
        variation: Variation,
    ) -> list[Finalist]:
        """Returns the registered poses in the frame of a camera, of which it sees the data."""
        pictures = Pictures.of(seen, self._usual)
        # A size between the candidates resembles fewer exemplars, a part of a body more of them.
        more = 1 if len(bodies) == 1 and variation == BRIEF else MORE
        kept = CUT_REFINED if pictures.cut else more
        finder = Finder(
            bodies,
            self.atlas,
            self.rolls,
            more * self.looked_up,
            kept * self.refined,
            self.cut_atlas() if pictures.cut else None,
            variation,
        )
        contest = Contest(self.comparison, finder, observation, pictures)
        return contest.finalists(finder.candidates(pictures), each)

    def _is_cut(self, observation: Observation) -> bool:
        """Returns whether every picture cuts the body off."""
        return all(Pictures.of(view.data, self._usual).cut for view in observation.each_view)

    def _resized(self, observation: Observation, finalists: Sequence[Finalist]) -> Finalist:
        """Returns the best pose in sizes between the candidates.

        Args:
            observation: The frame.
            finalists: Finalists of all sizes, the best first.
        """
        # A body that no border cuts off is in the picture as a whole: feet beyond it are missing.
        cut = self._is_cut(observation)
        scan = Scan(observation.points, observation.sight if cut else None)
        bests = {one.body.size: one for one in reversed(finalists)}
        fits = [fit(scan, one.body, one.pose, self._usual) for one in bests.values()]
        best = resized(scan, self.template, min(fits, key=_misfit), self._sizes)
        found = self.comparison.finalist(best.body, best.pose, observation)
        return self.comparison.recovered(found, observation)


def _misfit(candidate: Candidate) -> float:
    return candidate.misfit
