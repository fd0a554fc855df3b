"""The contest of one frame: refined exemplars are registered, the best searched for their limbs."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np

from regkit.observation import Observation
from regkit.search.exemplars import Exemplar, Finder, Pictures
from regkit.skeleton import Mirroring, Pose
from regkit.start import Finalist
from regkit_plugins.starts.exemplars.finalists import Comparison

SEARCHED = 6
"""The best sixth of the finalists of each size are registered again with a search of their limbs,
which takes ten times as long; the others count in the choice and the mean as they are.

With 16 finalists 78.5 % of 200 hands are right after ``best``, 100 % of 100 people and 93.3 % of
120 folded ones; with 6 finalists, half of them searched, which takes as long, it is 76.0, 99.0 and
93.3 % (development set of ``benchmarks/starts.py``).

Of a body that the picture cuts off all are: with fewer data, the best is less often among the
better half (120 bodies each of the development set: 83.3 % right in both cases with 65 % in view,
80.0 instead of 77.5 % with 50 %).
"""

MIRRORED = 2
"""Number of finalists whose mirror images are registered too: from the front and from behind a
body looks alike."""

DISAGREEMENT = 2.0
"""Cost of a full disagreement of the rendered body with a picture that cuts it off: with few data a
wrong pose explains the points as well, but not the picture.

Chosen on 120 bodies of which 65 % and 60 of which 50 % are in view (development set of
``benchmarks/starts.py``), where it changes at most two of 60 for the better.
"""


@dataclass(frozen=True)
class Contest:
    """Compares the candidates of a frame.

    Attributes:
        comparison: Registers the finalists.
        finder: The finder of the candidates.
        observation: The frame.
        pictures: Its pictures.
    """

    comparison: Comparison
    finder: Finder
    observation: Observation
    pictures: Pictures

    def finalists(self, candidates: Sequence[Exemplar], each: int) -> list[Finalist]:
        """Returns the registered poses, the best first.

        Args:
            candidates: The refined exemplars, the one that agrees best with the data first.
            each: Number of finalists of each size.
        """
        if self.pictures.cut:
            candidates = self._registered(candidates)
        finalists: list[Finalist] = []
        for body in self.finder.bodies:
            chosen = [one for one in candidates if one.body.size == body.size][:each]
            of_size = sorted(map(self._finalist, chosen), key=cost_of)
            searched = len(of_size) if self.pictures.cut else -(-len(of_size) // SEARCHED)
            finalists += [*map(self._recovered, of_size[:searched]), *of_size[searched:]]
        finalists.sort(key=cost_of)
        if len(self.finder.bodies) == 1 and self.pictures.one_sided:
            finalists += self._mirrored(finalists[:MIRRORED])
        return sorted(finalists, key=cost_of)

    def _finalist(self, one: Exemplar) -> Finalist:
        return self._compared(self.comparison.finalist(one.body, one.pose, self.observation))

    def _recovered(self, found: Finalist) -> Finalist:
        return self._compared(self.comparison.recovered(found, self.observation))

    def _compared(self, found: Finalist) -> Finalist:
        if not self.pictures.cut:
            return found
        differs = self.finder.disagreement(found.body, found.pose, self.pictures)
        return replace(found, disagreement=DISAGREEMENT * differs)

    def _mirrored(self, finalists: Sequence[Finalist]) -> list[Finalist]:
        """Returns the mirror images of finalists, registered; none of a one-sided skeleton."""
        mirroring = Mirroring.of(self.finder.bodies[0].skeleton)
        if mirroring is None:
            return []
        mirrored = []
        for one in finalists:
            pose = _mirror_image(one, mirroring)
            refined = self.finder.refined(one.body, pose, self.pictures)
            mirrored.append(self._recovered(self._finalist(refined)))
        return mirrored

    def _registered(self, candidates: Sequence[Exemplar]) -> list[Exemplar]:
        """Returns candidates after registration, the one that agrees best with the data first.

        What is in view of a body resembles many others, until it is registered.
        """
        found = []
        for one in candidates:
            pose = self.comparison.registered(one.body, one.pose, self.observation)
            disagreement = self.finder.disagreement(one.body, pose, self.pictures)
            found.append(Exemplar(one.body, pose, disagreement))
        return sorted(found, key=lambda one: one.disagreement)


def cost_of(finalist: Finalist) -> float:
    """Returns the cost of a finalist."""
    return finalist.cost


def _mirror_image(finalist: Finalist, mirroring: Mirroring) -> Pose:
    """Returns the pose that looks the same with near and far exchanged, seen by the camera."""
    placed = finalist.body.capsules.place(finalist.body.place(finalist.pose).transforms)
    middle = placed.ends.reshape(-1, 3).mean(axis=0)
    return mirroring.mirrored(finalist.pose, middle / np.linalg.norm(middle), middle)
