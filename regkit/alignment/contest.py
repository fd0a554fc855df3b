"""The contest of candidates: each is registered, and the method's energy and the overlap decide."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from regkit.clouds.agreement import Agreement, Agreements
from regkit.geometry.rigid import transformed
from regkit.interfaces import AlignmentCandidate, RegistrationResult
from regkit.system.arrays import Array
from regkit.system.brief import Brief

WORTH = 0.85
"""A candidate is registered if its overlap is at least this fraction of the best one's."""

LITTLE = 0.5
"""Results whose agreement is less than this fraction of the best one's are last."""

NEARLY = 0.93
"""A rival has at least this fraction of the agreement of the result."""

MARGIN = 0.05
"""A rival's energy is greater than that of the result by this at most: in nats per point for a
likelihood, in inliers for the methods of other libraries."""

APART = 0.05
"""A rival moves the source by at least this fraction of its size, as root mean square."""


@dataclass(frozen=True)
class Contestant:
    """A candidate after its registration.

    Attributes:
        candidate: The candidate.
        result: The result of the method.
        transform: T_target_source, (4, 4).
        agreement: Registration quality.
        energy: The method's energy on the whole clouds.
    """

    candidate: AlignmentCandidate
    result: RegistrationResult
    transform: Array
    agreement: Agreement
    energy: float

    @property
    def both(self) -> float:
        """Mean of the fractions of source and target that lie on the other."""
        return 0.5 * (self.agreement.fitness + self.agreement.overlap)


@dataclass(frozen=True)
class Rival(Brief):
    """Another transform that explains the clouds nearly as well.

    Attributes:
        transform: T_target_source, (4, 4).
        agreement: Registration quality.
        energy: The method's energy, less that of the result.
    """

    transform: Array
    agreement: Agreement
    energy: float


def worthwhile(candidates: Sequence[AlignmentCandidate]) -> list[AlignmentCandidate]:
    """Returns the candidates with nearly the overlap of the best, and those without an estimate."""
    known = [one.overlap for one in candidates if np.isfinite(one.overlap)]
    least = WORTH * max(known, default=0.0)
    best = candidates[0]
    return [one for one in candidates if one is best or not one.overlap < least]


def ranked(contestants: Sequence[Contestant]) -> list[Contestant]:
    """Returns the contestants, the best first: the least energy, if it agrees at all."""
    best = max(one.both for one in contestants)
    return sorted(contestants, key=lambda one: (one.both < LITTLE * best, one.energy, -one.both))


def rivals_of(order: Sequence[Contestant], agreements: Agreements) -> tuple[Rival, ...]:
    """Returns the rivals of the first contestant, which are clearly other transforms.

    Args:
        order: The contestants, the best first.
        agreements: The clouds.
    """
    best, source = order[0], agreements.source.points
    size = float(np.linalg.norm(np.ptp(source, axis=0)))
    found: list[Contestant] = []
    for one in order[1:]:
        others = [transformed(other.transform, source) for other in (best, *found)]
        mine = transformed(one.transform, source)
        apart = min(np.sqrt(((mine - other) ** 2).sum(axis=1).mean()) for other in others)
        equal = one.both >= NEARLY * best.both > 0.0 and one.energy <= best.energy + MARGIN
        if equal and apart >= APART * size:
            found.append(one)
    return tuple(Rival(one.transform, one.agreement, one.energy - best.energy) for one in found)
