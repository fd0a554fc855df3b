"""Volumes: primitives that fill a part of space."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from regkit.primitives.primitives import Primitives
from regkit.system.arrays import Array


def _sphere() -> Array:
    """Returns unit vectors in all directions, (P, 3), along 24 meridians."""
    polar, around = np.mgrid[0 : np.pi : 13j, 0 : 2.0 * np.pi : 25j][:, :, :-1].reshape(2, -1)
    flat = np.sin(polar)
    return np.column_stack([flat * np.cos(around), np.cos(polar), flat * np.sin(around)])


SPHERE = _sphere()
"""Directions in which pictures sample surfaces, (P, 3)."""


@dataclass(frozen=True)
class Volumes(Primitives):
    """Primitives that fill a part of space; terms treat them as ellipsoids of two scales."""

    def surface_points(self) -> Array:
        """Returns points all over the surfaces, in the primitives' axes, (K, P, 3) [m].

        The origin is the primitive's centre. Pictures show the outline of the points' hull. The
        default is the ellipsoid of two scales; a subclass with another surface overrides it.
        """
        return np.asarray(2.0 * self.scales[:, None, :] * SPHERE)
