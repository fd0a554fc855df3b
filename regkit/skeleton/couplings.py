"""Coupled hinges: angles that follow from those of others, as in a finger's last joint."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import numpy as np

from regkit.system.arrays import Array, Indices


@dataclass(frozen=True)
class Couplings:
    """``follower = ratio * leader + offset``, for C pairs of the hinges.

    A follower has no coordinate of its own; so every solver holds a coupling exactly.

    Attributes:
        hinges: How many hinges there are.
        followers: Which hinges follow, (C,).
        leaders: Which hinge each of them follows, itself no follower, (C,).
        ratios: (C,).
        offsets: (C,) [rad].
    """

    hinges: int
    followers: Indices
    leaders: Indices
    ratios: Array
    offsets: Array

    def __len__(self) -> int:
        """Number C of coupled hinges."""
        return len(self.followers)

    @cached_property
    def independent(self) -> Indices:
        """The hinges that follow no other, in their order."""
        return np.setdiff1d(np.arange(self.hinges), self.followers)

    @cached_property
    def spread(self) -> Array:
        """By how much each hinge turns with each independent one, (n_hinge, n_hinge - C)."""
        spread = np.zeros((self.hinges, self.hinges))
        spread[self.independent, self.independent] = 1.0
        spread[self.followers, self.leaders] = self.ratios
        return spread[:, self.independent]

    def coupled(self, hinges: Array) -> Array:
        """The same angles (..., n_hinge) [rad], those of the followers made to follow."""
        if not len(self):
            return hinges
        coupled = hinges.copy()
        coupled[..., self.followers] = self.ratios * hinges[..., self.leaders] + self.offsets
        return coupled

    def misfit(self, hinges: Array) -> Array:
        """How far each follower (C,) is from where it should be [rad]."""
        return np.asarray(hinges - self.coupled(hinges))[self.followers]

    def narrowed(self, limits: Array) -> Array:
        """The hinges' limits (n_hinge, 2) [rad], those of leaders such that followers keep theirs.

        An empty interval has its ends reversed.
        """
        narrowed = limits.copy()
        for follower, leader, ratio, offset in zip(
            self.followers, self.leaders, self.ratios, self.offsets, strict=True
        ):
            ends = np.sort((limits[follower] - offset) / ratio)
            narrowed[leader, 0] = max(narrowed[leader, 0], ends[0])
            narrowed[leader, 1] = min(narrowed[leader, 1], ends[1])
        return narrowed
