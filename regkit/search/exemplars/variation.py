"""Variants of poses: some limbs are exchanged, and the trunk is shaken."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from regkit.body import Body
from regkit.geometry.rotation import from_vector, product
from regkit.search.exemplars.atlas import Atlas
from regkit.search.exemplars.lookup import Matches
from regkit.search.limbs import limbs_of
from regkit.skeleton import Pose
from regkit.system.arrays import Indices

SECOND = 0.3
"""Probability that a second limb is exchanged."""

OWN = 0.15
"""Probability that the limbs are those of another of the poses, and not of an exemplar."""

BENT = 0.15
"""Standard deviation of the trunk's joints [rad]."""


@dataclass(frozen=True)
class Variation:
    """How much poses are varied.

    Attributes:
        rounds: Number of rounds, each of which begins from the best poses so far.
        poses: Number of poses of which a round makes variants.
        each: Number of variants of each pose.
        kept: Number of variants that are refined in a round.
    """

    rounds: int
    poses: int
    each: int
    kept: int


BRIEF, THOROUGH = Variation(3, 8, 60, 12), Variation(4, 24, 60, 36)
"""The usual variation, and that where no pose was good enough.

Chosen on 90 to 150 folded people and 100 others, and on 12 folded people whose start was not found
without the second one (development set of ``benchmarks/starts.py``).
"""


def varied(
    body: Body,
    atlas: Atlas,
    poses: Sequence[Pose],
    sizes: Indices,
    each: int,
    random: np.random.Generator,
) -> Matches:
    """Returns variants of poses, with limbs of exemplars or of each other.

    Joints of the trunk may exceed their limits a little.

    Args:
        body: The body.
        atlas: The exemplars.
        poses: The poses, N of them.
        sizes: Index of the size of each, (N,).
        each: Number of variants of each pose.
        random: Source of the variants.
    """
    count = len(poses) * each
    roots = np.repeat([pose.root for pose in poses], each, axis=0)
    own_balls = np.array([pose.balls for pose in poses])
    own_hinges = np.array([pose.hinges for pose in poses])
    balls, hinges = np.repeat(own_balls, each, axis=0), np.repeat(own_hinges, each, axis=0)
    rows = random.integers(len(atlas), size=count)
    other_balls, other_hinges = atlas.balls[rows].astype(float), atlas.hinges[rows].astype(float)
    exchanged = np.flatnonzero(random.uniform(size=count) < OWN)
    givers = random.integers(len(poses), size=len(exchanged))
    other_balls[exchanged], other_hinges[exchanged] = own_balls[givers], own_hinges[givers]
    limbs = limbs_of(body)
    chosen = random.integers(max(len(limbs), 1), size=(count, 2))
    chosen[random.uniform(size=count) >= SECOND, 1] = -1
    steps = BENT * random.normal(size=(*balls.shape[:2], 3))
    for index, limb in enumerate(limbs):
        with_it = np.flatnonzero((chosen == index).any(axis=1))[:, None]
        balls[with_it, limb.balls] = other_balls[with_it, limb.balls]
        hinges[with_it, limb.hinges] = other_hinges[with_it, limb.hinges]
        steps[:, limb.balls] = 0.0
    balls = product(balls, from_vector(steps))
    return Matches(np.repeat(sizes, each), roots, balls, hinges)
