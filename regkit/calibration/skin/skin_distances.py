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
    """

    lengths: Array
    directions: Array
    corners: Indices
    shares: Array

    @classmethod
    def joined(cls, *several: SkinDistances) -> SkinDistances:
        """Returns all distances one after the other."""
        return cls(
            *(
                np.concatenate([getattr(one, name) for one in several])
                for name in ("lengths", "directions", "corners", "shares")
            )
        )
