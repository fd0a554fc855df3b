"""People who kneel, sit, squat, crouch or curl up, from all sides: the development of the search.

No case is a pose of a motion; each is drawn from ranges of joint angles. The set ``test`` has other
bodies and other draws, and shares its postures with the set ``development``.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from functools import partial
from itertools import product

import numpy as np
from _starts_bodies import SUBJECTS, Set
from _starts_case import Case, subset
from _starts_judge import judged
from _starts_options import Options
from _starts_people import ELEVATIONS, FAR, HEADINGS, ROLLS, WITHIN
from _starts_postures import POSTURES, drawn_posture
from _starts_shots import Shots, kept
from _starts_table import header, parts, row
from _starts_views import seen, surface, view

from regkit_synthesis.bodies.bodies import HumanBody
from regkit_synthesis.bodies.body_map import body_map
from regkit_synthesis.recordings.scene import SR4000

DRAWS = 40
"""Number of cases of each body in each posture."""


@dataclass(frozen=True)
class FoldedCase(Case):
    """A person in a folded posture.

    Attributes:
        posture: Name of the posture.
        draw: Number of the draw.
    """

    posture: str
    draw: int

    @property
    def name(self) -> str:
        """Returns everything that the frames depend on, in words."""
        return f"{self.subject.name}, {self.posture}, draw {self.draw}"

    def shots(self) -> Shots:
        """Returns one frame."""
        return kept(f"folded: {self.name}", self._rendered)

    def _rendered(self) -> Shots:
        random = self.random()
        body = HumanBody(self.subject.mesh(), body_map("anny_cmu"))
        pose = body.moved(drawn_posture(self.posture, random).motion())(0.0)
        angles = [float(random.choice(some)) for some in (HEADINGS, ELEVATIONS, ROLLS)]
        T_camera_ground = view(*angles, surface(body.mesh, [pose]))
        return seen(body.mesh, body.landmarks, [T_camera_ground @ pose], SR4000, self.random)


def cases(chosen: Set, some: int | None = None, seed: int = 0) -> list[FoldedCase]:
    """Returns all cases of a set, or a random subset of them in random order."""
    every = product(SUBJECTS[chosen], POSTURES, np.arange(DRAWS).tolist())
    return subset([FoldedCase(*one) for one in every], some, seed)


def figures(options: Options) -> dict[str, object]:
    """Prints the table of folded people, and returns its figures."""
    header("folded people")
    every = cases(options.chosen, options.some, options.seed)
    outcomes = options.mapped("folded people", partial(judged, options.start), every)
    known = row("size known", outcomes, WITHIN, FAR)
    parts([replace(one, case=one.case.rpartition(",")[0]) for one in outcomes], WITHIN)
    return {"folded": {"known_size_percent": known.percent, "seconds": known.seconds}}
