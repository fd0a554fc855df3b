"""Deformations from what a library displaced: by its kernel, or interpolated."""

from __future__ import annotations

from abc import ABC, abstractmethod
from dataclasses import dataclass, replace
from functools import cached_property
from typing import Self

import numpy as np
import scipy

from regkit.interfaces import Deformation
from regkit.system.arrays import Array

BLOCK = 2000
"""Number of points that are moved at once, which bounds the memory."""

NEIGHBOURS = 30
"""Number of displacements from which one is interpolated."""


class MovesOthers(ABC):
    """What moves points, in units of the body's extent."""

    @abstractmethod
    def displacements(self, points: Array) -> Array:
        """Returns the displacements (N, 3) of points (N, 3)."""


@dataclass(frozen=True)
class KernelDisplacements(MovesOthers):
    """A sum of Gaussians, as coherent point drift has it.

    Source: Myronenko and Song, Point set registration: Coherent point drift, 2010, eq. 19.

    Attributes:
        centres: Centres of the Gaussians, (M, 3).
        weights: Their weights, (M, 3).
        width: Their standard deviation.
    """

    centres: Array
    weights: Array
    width: float

    def displacements(self, points: Array) -> Array:
        """Returns the displacements (N, 3) of points (N, 3)."""
        squares = scipy.spatial.distance.cdist(points, self.centres, "sqeuclidean")
        return np.asarray(np.exp(-0.5 * squares / self.width**2) @ self.weights)


@dataclass(frozen=True)
class InterpolatedDisplacements(MovesOthers):
    """Displacements that are interpolated linearly from the nearest places.

    Attributes:
        places: Different places whose displacements are known, (M, 3).
        known: Their displacements, (M, 3).
    """

    places: Array
    known: Array

    def displacements(self, points: Array) -> Array:
        """Returns the displacements (N, 3) of points (N, 3)."""
        return np.asarray(self._interpolator(points))

    @cached_property
    def _interpolator(self) -> scipy.interpolate.RBFInterpolator:
        near = min(NEIGHBOURS, len(self.places))
        return scipy.interpolate.RBFInterpolator(
            self.places, self.known, neighbors=near, kernel="linear"
        )


@dataclass(frozen=True)
class Scaled(Deformation):
    """Displacements in units of the body's extent, in the world.

    Attributes:
        centre: Centre of the body, (3,) [m].
        scale: Its extent [m].
        moving: What moves points, in units of it about the centre.
    """

    centre: Array
    scale: float
    moving: MovesOthers

    def moved(self, points: Array) -> Array:
        """Returns where points (N, 3) [m] go."""
        parts = np.array_split(points, max(1, len(points) // BLOCK))
        return np.concatenate([part + self._displacements(part) for part in parts])

    def shifted(self, origin: Array) -> Self:
        """Returns the same deformation in a world whose origin is at ``-origin`` (3,) [m]."""
        return replace(self, centre=self.centre + origin)

    def _displacements(self, points: Array) -> Array:
        return self.scale * self.moving.displacements((points - self.centre) / self.scale)
