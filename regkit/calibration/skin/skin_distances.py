"""Distances between data and a skin."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from regkit.system.arrays import Array, Indices


@dataclass(frozen=True)
class SkinDistances:
    """R distances from points of a skin to data, zero where both meet.

    Attributes:
        lengths: Signed distances along the directions, (R,) [m].
        directions: Unit directions from the skin to the data, (R, 3), which are held.
        corners: Vertices of the triangle of each point of the skin, (R, 3).
        shares: Barycentric coordinates of the points, (R, 3).
        lost: Number of data beside these that meet no point of the skin.
    """

    lengths: Array
    directions: Array
    corners: Indices
    shares: Array
    lost: int = 0

    @classmethod
    def none(cls, lost: int = 0) -> SkinDistances:
        """Returns no distances."""
        indices = np.zeros((0, 3), dtype=np.intp)
        return cls(np.zeros(0), np.zeros((0, 3)), indices, np.zeros((0, 3)), lost)

    def __len__(self) -> int:
        """Number of data, of which some may be lost."""
        return len(self.lengths) + self.lost

    @classmethod
    def joined(cls, *several: SkinDistances) -> SkinDistances:
        """Returns all distances one after the other."""
        names = ("lengths", "directions", "corners", "shares")
        arrays = {name: np.concatenate([getattr(one, name) for one in several]) for name in names}
        return cls(**arrays, lost=sum(one.lost for one in several))
