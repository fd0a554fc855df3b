"""Coupled hinges: their angle or displacement is an affine function of another one of its kind."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import numpy as np

from regkit.system.arrays import Array, Indices


@dataclass(frozen=True)
class Couplings:
    """``follower = ratio * leader + offset`` for C pairs of hinges.

    A follower is not an optimisation variable, so every solver satisfies a coupling exactly.

    Attributes:
        hinges: Number of hinges, n_hinge.
        followers: Indices of the following hinges, (C,).
        leaders: Index of the hinge that each follower follows, (C,); a leader follows no other.
        ratios: Ratio of each coupling, (C,).
        offsets: Offset of each coupling, (C,) [rad or m].
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
        """Indices of the hinges that follow no other, ascending, (n_hinge - C,)."""
        return np.setdiff1d(np.arange(self.hinges), self.followers)

    @cached_property
    def jacobian(self) -> Array:
        """Derivative of all hinge angles to the independent ones, (n_hinge, n_hinge - C)."""
        jacobian = np.zeros((self.hinges, self.hinges))
        jacobian[self.independent, self.independent] = 1.0
        jacobian[self.followers, self.leaders] = self.ratios
        return jacobian[:, self.independent]

    def coupled(self, hinges: Array) -> Array:
        """Returns the angles (..., n_hinge) [rad] with the followers set from their leaders."""
        if not len(self):
            return hinges
        coupled = hinges.copy()
        coupled[..., self.followers] = self.ratios * hinges[..., self.leaders] + self.offsets
        return coupled

    def residuals(self, hinges: Array) -> Array:
        """Returns the deviation (C,) [rad] of each follower from its coupling.

        Args:
            hinges: Hinge angles, (n_hinge,) [rad].
        """
        return np.asarray(hinges - self.coupled(hinges))[self.followers]

    def narrowed(self, limits: Array) -> Array:
        """Returns the limits (n_hinge, 2) [rad] with leaders narrowed to their followers' limits.

        An empty interval has its lower end above its upper end.

        Args:
            limits: Lower and upper angle of each hinge, (n_hinge, 2) [rad].
        """
        narrowed = limits.copy()
        for follower, leader, ratio, offset in zip(
            self.followers, self.leaders, self.ratios, self.offsets, strict=True
        ):
            ends = np.sort((limits[follower] - offset) / ratio)
            narrowed[leader, 0] = max(narrowed[leader, 0], ends[0])
            narrowed[leader, 1] = min(narrowed[leader, 1], ends[1])
        return narrowed
