"""Volumes: primitives that fill a part of space."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from regkit.primitives.primitives import Primitives
from regkit.system.arrays import Array


def _sphere() -> Array:
    """Unit vectors in all directions, (P, 3), along 24 meridians."""
    polar, around = np.mgrid[0 : np.pi : 13j, 0 : 2.0 * np.pi : 25j][:, :, :-1].reshape(2, -1)
    flat = np.sin(polar)
    return np.column_stack([flat * np.cos(around), np.cos(polar), flat * np.sin(around)])


SPHERE = _sphere()
"""Directions in which surfaces are sampled for pictures."""


@dataclass(frozen=True)
class Volumes(Primitives):
    """Primitives that fill a part of space, which terms take as the ellipsoids of two scales."""

    def surface_points(self) -> Array:
        """Points all over the surface of each, in its own axes about its centre, (K, P, 3) [m].

        Pictures show the outline of their hull. Here it is that of the ellipsoid of two scales; a
        subclass whose surface is another one overrides it.
        """
        return np.asarray(2.0 * self.scales[:, None, :] * SPHERE)
