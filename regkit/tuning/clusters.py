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
        parts: The clusters; none if there are too few points.
        cost: Number of primitives that are added.
        gain: Reduction of the points' squared distances to their mean, for each of those [m^5].
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
        volume: Volume for which a point stands [m^3].
        twin: Segment that carries the mirror image of the primitive, which may be the same; None if
            there is no mirror image.
        reflection: Matrix that maps positions in the segment's frame to those of the mirror image
            in the twin's, (3, 3).
        middle: Whether the primitive is its own mirror image.
    """

    segment: int
    points: Array
    volume: float
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

    def halved(self) -> Cluster:
        """Returns the cluster in the middle that has this one's points of the first side."""
        return replace(self, points=self.points[self._heights > 0.0], middle=True)

    @cached_property
    def division(self) -> Division:
        """The division by which the squared distances fall the most."""
        if not self.middle:
            return self._in_two(self.points, self.primitives)
        # Two in the middle differ in the positions on the plane alone.
        heights = self._heights
        flat = self._in_two(self.points - heights[:, None] * self._normal, 1)
        gain = 2.0 * self.volume * len(heights) * float(heights.mean()) ** 2
        if 2.0 * flat.gain >= gain or len(heights) < FEWEST:
            return replace(flat, gain=2.0 * flat.gain)
        return Division((replace(self, middle=False),), 1, gain)

    def _in_two(self, places: Array, cost: int) -> Division:
        """Returns the division by the two means of the places (N, 3) [m] of the points."""
        chosen = _halves(places)
        sizes = int(chosen.sum()), int((~chosen).sum())
        if min(sizes) < FEWEST:
            return Division((), 0, 0.0)
        apart = places[chosen].mean(axis=0) - places[~chosen].mean(axis=0)
        parts = tuple(replace(self, points=self.points[own]) for own in (chosen, ~chosen))
        gain = self.volume * sizes[0] * sizes[1] / len(places) * float(apart @ apart)
        return Division(parts, cost, gain)

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
