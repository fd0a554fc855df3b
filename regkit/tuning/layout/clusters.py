"""Clusters of points inside a body, each for one primitive, or for one on each side."""

from __future__ import annotations

from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from regkit.system.arrays import Array

FEWEST = 8
"""Least number of points of a cluster."""

ROUNDS = 50
"""Most rounds in which points are assigned to the nearer of two means."""


@dataclass(frozen=True)
class Division:
    """A cluster in two, or in one on each side.

    Attributes:
        parts: The clusters.
        cost: Number of primitives that are added.
        gain: Reduction of the points' squared distances to their means times their mass, for each
            of those.
    """

    parts: tuple[Cluster, ...]
    cost: int
    gain: float


@dataclass(frozen=True)
class Cluster:
    """Points inside a segment, for one primitive.

    Attributes:
        segment: The segment.
        points: Points in its frame, (N, 3) [m]; of a cluster in the middle those on the first side.
        mass: How much a point counts, such as the volume for which it stands [m^3].
        twin: Segment that carries the mirror image of the primitive, which may be the same; None if
            there is no mirror image.
        reflection: Matrix that maps positions in the segment's frame to those of the mirror image
            in the twin's, (3, 3).
        middle: Whether the primitive is its own mirror image.
    """

    segment: int
    points: Array
    mass: float
    twin: int | None
    reflection: Array
    middle: bool = False

    @property
    def primitives(self) -> int:
        """Number of primitives: 2 with a mirror image that is another one."""
        return 1 if self.twin is None or self.middle else 2

    @property
    def mirrored(self) -> Array:
        """The mirror images of the points in the twin's frame, (N, 3) [m]."""
        return np.asarray(self.points @ self.reflection.T)

    def with_twin(self, twin: int, reflection: Array) -> Cluster:
        """Returns the cluster with a mirror image in another segment, or in the same."""
        return replace(self, twin=twin, reflection=reflection)

    def in_the_middle(self) -> Cluster:
        """Returns the cluster that is its own mirror image, of the points on the first side."""
        return replace(self, points=self.points[self._heights > 0.0], middle=True)

    @cached_property
    def divisions(self) -> tuple[Division, ...]:
        """The possible divisions: by two means, and of a cluster in the middle by the plane."""
        if not self.middle:
            return self._by_means(self.points, self.primitives, 1.0)
        heights = self._heights
        gain = 2.0 * self.mass * len(heights) * float(heights.mean()) ** 2
        sides = Division((replace(self, middle=False),), 1, gain)
        # Two in the middle differ in the positions on the plane alone; all points are there twice.
        return *self._by_means(self.points - heights[:, None] * self._normal, 1, 2.0), sides

    def _by_means(self, places: Array, cost: int, times: float) -> tuple[Division, ...]:
        """Returns the division by two means of the places (N, 3) [m] of the points, if possible."""
        chosen = _halves(places)
        sizes = int(chosen.sum()), int((~chosen).sum())
        if min(sizes) < FEWEST:
            return ()
        apart = places[chosen].mean(axis=0) - places[~chosen].mean(axis=0)
        parts = tuple(replace(self, points=self.points[own]) for own in (chosen, ~chosen))
        gain = times * self.mass * sizes[0] * sizes[1] / len(places) * float(apart @ apart)
        return (Division(parts, cost, gain),)

    @cached_property
    def _normal(self) -> Array:
        """Unit normal (3,) of the plane in which a reflection within one frame mirrors."""
        outer = 0.5 * (np.eye(3) - self.reflection)
        largest = int(np.diag(outer).argmax())
        return np.asarray(outer[largest] / np.sqrt(outer[largest, largest]))

    @cached_property
    def _heights(self) -> Array:
        """Distances of the points from that plane, (N,) [m]."""
        return np.asarray(self.points @ self._normal)


def _halves(points: Array) -> NDArray[np.bool_]:
    """Returns which points (N, 3) are in the first of two clusters along their longest direction.

    Source: Lloyd, Least squares quantization in PCM, IEEE Trans. Inf. Theory 28, 1982.
    """
    centred = points - points.mean(axis=0)
    chosen = centred @ np.linalg.eigh(centred.T @ centred)[1][:, -1] > 0.0
    for _ in range(ROUNDS):
        if not 0 < chosen.sum() < len(points):
            break
        first, second = points[chosen].mean(axis=0), points[~chosen].mean(axis=0)
        nearer = (points - 0.5 * (first + second)) @ (first - second) > 0.0
        if (nearer == chosen).all():
            break
        chosen = nearer
    return np.asarray(chosen)
