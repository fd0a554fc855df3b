"""The course of movements in time: when each part of a body moves, pauses and goes on."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Self

import numpy as np
from numpy.typing import NDArray

from regkit.system.arrays import Array, Indices
from regkit.system.brief import Brief

SHORTEST, LONGEST = 8.0, 60.0
"""Durations of a movement from one pose to the next [frames]: a quarter of a second to two."""

STILL = 0.25
"""Probability that a part does not move."""

TOGETHER = 0.5
"""Probability that all parts begin and end their movements at the same time."""


@dataclass(frozen=True)
class Pace(Brief):
    """Movements of P parts through K keys each, one after the other.

    Attributes:
        starts: Time at which each part leaves its first K - 1 keys, (P, K - 1) [frames].
        durations: Duration of each movement, (P, K - 1) [frames].
        still: Whether the part stays where it is at the time 0, (P,).
    """

    starts: Array
    durations: Array
    still: NDArray[np.bool_]

    @classmethod
    def sampled(cls, random: np.random.Generator, parts: int, frames: int) -> Self:
        """Returns random movements that go on for ``frames`` at least.

        The time 0 is somewhere in the first movement. Durations are uniform in their logarithm.
        """
        count = int(np.ceil(frames / SHORTEST)) + 1
        low, high = np.log([SHORTEST, LONGEST])
        durations = np.exp(random.uniform(low, high, size=(parts, count)))
        begun = random.uniform(size=(parts, 1))
        if random.uniform() < TOGETHER:
            durations[:], begun[:] = durations[0], begun[0]
        starts = np.cumsum(durations, axis=1) - durations - begun * durations[:, :1]
        return cls(starts, durations, random.uniform(size=parts) < STILL)

    @property
    def keys(self) -> int:
        """Number K of keys."""
        return int(self.starts.shape[1]) + 1

    def at(self, times: Array) -> tuple[Indices, Array]:
        """Returns the key that each part has left, (T, P), and the share of its way to the next.

        Parts start and stop smoothly.

        Args:
            times: Times from 0 on, (T,) [frames].
        """
        own = np.where(self.still, 0.0, times[:, None])
        left = (own[..., None] >= self.starts).sum(axis=-1) - 1
        parts = np.arange(len(self.still))
        share = (own - self.starts[parts, left]) / self.durations[parts, left]
        share = np.clip(share, 0.0, 1.0)
        return left, np.asarray(share * share * (3.0 - 2.0 * share))
