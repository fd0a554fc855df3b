"""The search of one template: exemplars become finalists, in one size or over all of them."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np

from regkit.body import Body
from regkit.interfaces import Template
from regkit.observation import Observation
from regkit.search.exemplars import Atlas, Exemplar, Finder, Pictures
from regkit.skeleton import Mirroring, Pose
from regkit.start import Candidate, Finalist, Scan
from regkit.start.sizes import fit, resized
from regkit.system.arrays import Array
from regkit_plugins.starts.exemplars.finalists import Comparison

MORE = 2
"""Factor of the numbers of exemplars that are looked up and refined over all sizes together, and of
those that are refined and registered if the picture cuts the body off."""

MIRRORED = 2
"""Number of finalists whose mirror images are registered too: from the front and from behind a
body looks alike."""

DISAGREEMENT = 2.0
"""Cost of a full disagreement of the rendered body with a picture that cuts it off: with few data a
wrong pose explains the points as well, but not the picture.

Chosen on 120 bodies of which 65 % and 60 of which 50 % are in view (development set of
``benchmarks/starts.py``), where it changes at most two of 60 for the better.
"""

PER_SIZE = 2
"""Least number of finalists of each candidate size."""


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

    def doubts(self, body: Body, observation: Observation) -> list[str]:
        """Returns what speaks against a body of this size in a frame, whatever its pose."""
        pictures, doubts = Pictures.of(observation, body.size), []
        if len(self._sizes) > 1 and not self._sizes[0] < body.size < self._sizes[-1]:
            doubts.append(f"the size, {body.size:.3g} m, is at an end of the template's range")
        share = pictures.area / (self.atlas.least_area() * body.size**2)
        if not pictures.cut and share < 1.0:
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
        self, bodies: Sequence[Body], observation: Observation, each: int
    ) -> list[Finalist]:
        """Returns the registered poses, the best first.

        Args:
            bodies: The body in one or more sizes.
            observation: The frame.
            each: Number of finalists of each size.
        """
        pictures = Pictures.of(observation, self._usual)
        # A size between the candidates resembles fewer exemplars, a part of a body more of them.
        more = 1 if len(bodies) == 1 else MORE
        kept = MORE if pictures.cut else more
        each *= MORE if pictures.cut else 1
        finder = Finder(
            bodies,
            self.atlas,
            self.rolls,
            more * self.looked_up,
            kept * self.refined,
            self.cut_atlas() if pictures.cut else None,
        )
        candidates = finder.candidates(pictures)
        if pictures.cut:
            candidates = self._registered(finder, candidates, observation, pictures)
        chosen: list[Exemplar] = []
        for body in bodies:
            chosen += [one for one in candidates if one.body.size == body.size][:each]

        def finalist(one: Exemplar) -> Finalist:
            found = self.comparison.finalist(one.body, one.pose, observation)
            if not pictures.cut:
                return found
            differs = finder.disagreement(found.body, found.pose, pictures)
            return replace(found, disagreement=DISAGREEMENT * differs)

        finalists = sorted(map(finalist, chosen), key=_cost)
        mirroring = Mirroring.of(bodies[0].skeleton)
        if len(bodies) == 1 and mirroring is not None and pictures.one_sided:
            for one in finalists[:MIRRORED]:
                mirrored = finder.refined(one.body, _mirrored(one, mirroring), pictures)
                finalists.append(finalist(mirrored))
        return sorted(finalists, key=_cost)

    def _registered(
        self,
        finder: Finder,
        candidates: Sequence[Exemplar],
        observation: Observation,
        pictures: Pictures,
    ) -> list[Exemplar]:
        """Returns candidates after registration, the one that agrees best with the data first.

        What is in view of a body resembles many others, until it is registered.
        """
        found = []
        for one in candidates:
            pose = self.comparison.registered(one.body, one.pose, observation)
            disagreement = finder.disagreement(one.body, pose, pictures)
            found.append(Exemplar(one.body, pose, disagreement))
        return sorted(found, key=lambda one: one.disagreement)

    def _resized(self, observation: Observation, finalists: Sequence[Finalist]) -> Finalist:
        """Returns the best pose in sizes between the candidates.

        Args:
            observation: The frame.
            finalists: Finalists of all sizes, the best first.
        """
        scan = Scan.of(observation)
        bests = {one.body.size: one for one in reversed(finalists)}
        fits = [fit(scan, one.body, one.pose, self._usual) for one in bests.values()]
        best = resized(scan, self.template, min(fits, key=_misfit), self._sizes)
        return self.comparison.finalist(best.body, best.pose, observation)


def _mirrored(finalist: Finalist, mirroring: Mirroring) -> Pose:
    """Returns the pose that looks the same with near and far exchanged, seen by the camera."""
    placed = finalist.body.capsules.place(finalist.body.place(finalist.pose).transforms)
    middle = placed.ends.reshape(-1, 3).mean(axis=0)
    return mirroring.mirrored(finalist.pose, middle / np.linalg.norm(middle), middle)


def _misfit(candidate: Candidate) -> float:
    return candidate.misfit


def _cost(finalist: Finalist) -> float:
    return finalist.cost
