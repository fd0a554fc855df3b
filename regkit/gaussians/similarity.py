"""What the kernels that compare Gaussians have in common: everything but how pairs are weighed."""

from __future__ import annotations

from abc import abstractmethod
from dataclasses import dataclass
from functools import reduce
from typing import ClassVar

import numpy as np

from regkit.gaussians.pairs import Pairs
from regkit.gaussians.seen import Seen
from regkit.gaussians.visible import seen
from regkit.gaussians.volume import Frozen
from regkit.interfaces import Response, Similarity
from regkit.observation import Observation
from regkit.primitives import Gaussians, Placed
from regkit.system.arrays import Array, Indices


@dataclass(frozen=True)
class _Group:
    """Data of one variance [m^2], their weights (N,), and log_scale (K,) in the start pose."""

    variance: float
    weights: Array
    pairs: Pairs
    log_scales: Array


class GaussianSimilarity(Similarity):
    """An energy of the densities exp(log_scale - 1/2 q^T P q) of all pairs, with q = y - m.

    P is the inverse of the model's and the data's covariance together. A kernel says what energy
    the densities make, and by how much each pair weighs in it: the energy's derivative is the sum
    over the pairs of weight times the derivative of 1/2 q^T P q - log_scale. All else follows from
    the moments of the data under these weights. Data of different variances are treated in turn.

    Args:
        observation: The data.
        start: The primitives in the start pose.
        data_weights: Of the points, (N,), summing to one.
        log_weights: Of the primitives, (K,), part of log_scale.
        smoothing: Standard deviation [m] of the Gaussian that smooths the data.
        frozen: Whether covariances keep their orientation of the start pose.
    """

    volume_power: ClassVar[float]
    """log_scale holds 1/2 log |P|, and so many times 1/2 log |C|."""

    def __init__(
        self,
        observation: Observation,
        start: Placed[Gaussians],
        *,
        data_weights: Array,
        log_weights: Array,
        smoothing: float,
        frozen: bool,
    ) -> None:
        self._camera = observation.camera
        self._log_weights = log_weights
        self._start = start
        self._seen_at_start = seen(start, self._camera)
        self._frozen = frozen
        # The features of pairs cancel badly far from the origin.
        self._centre = observation.points.mean(axis=0)
        points = observation.points - self._centre
        variances, self._group_of = _distinct(observation.variances)
        self._groups = [
            self._group(float(variance) + smoothing**2, points[own], data_weights[own])
            for variance, own in ((v, self._group_of == g) for g, v in enumerate(variances))
        ]

    @abstractmethod
    def weigh(self, densities: Array, data_weights: Array) -> float | None:
        """Returns the energy of densities (K, N), which hold the data weights (N,) already.

        The densities become the pairs' weights in place. None stands for minus the sum of these,
        which the moments hold anyway.
        """

    @abstractmethod
    def inliers(self, densities: Array, data_weights: Array) -> Array:
        """Inlier probabilities by densities (K, N), which hold the data weights (N,) already.

        Returns:
            (N,), from 0 to 1.
        """

    def inlier_probability(self, placed: Placed[Gaussians]) -> Array:
        """Returns the probability (N,) that each point is an inlier."""
        view = self._view(placed)
        probability = np.empty(len(self._group_of))
        for index, group in enumerate(self._groups):
            densities, _ = self._densities(group, view)
            probability[self._group_of == index] = self.inliers(densities, group.weights)
        return probability

    def __call__(self, placed: Placed[Gaussians], *, curvature: bool = False) -> Response:
        """The energy, the wrenches about the primitives' centres, and the Gauss-Newton blocks."""
        view = self._view(placed)
        levers = placed.centres - view.means if curvature else None
        parts = [self._part(group, view, levers) for group in self._groups]
        return reduce(Response.__add__, parts)

    def energy(self, placed: Placed[Gaussians]) -> float:
        """Returns the energy alone, without moments."""
        view, total = self._view(placed), 0.0
        for group in self._groups:
            densities, _ = self._densities(group, view)
            energy = self.weigh(densities, group.weights)
            total += -float(densities.sum()) if energy is None else energy
        return total

    def _part(self, group: _Group, view: Seen, levers: Array | None) -> Response:
        """What the data of one variance contribute."""
        densities, precisions = self._densities(group, view)
        energy = self.weigh(densities, group.weights)
        moments = group.pairs.moments(densities, precisions)
        return Response(
            energy=-float(moments.mass.sum()) if energy is None else energy,
            wrenches=view.wrenches(moments, self.volume_power),
            stiffness=None if levers is None else moments.stiffness(levers),
        )

    def _densities(self, group: _Group, view: Seen) -> tuple[Array, Array]:
        """Densities (K, N) of the data of one variance, and the precisions (K, 3, 3) they have."""
        precisions = view.precisions(group.variance)
        log_scales = group.log_scales if view.rigid else self._log_scales(view, precisions)
        means = view.means - self._centre
        return group.pairs.densities(means, precisions, log_scales), precisions

    def _group(self, variance: float, points: Array, weights: Array) -> _Group:
        precisions = self._seen_at_start.precisions(variance)
        log_scales = self._log_scales(self._seen_at_start, precisions)
        return _Group(variance, weights, Pairs(points, weights, len(self._start)), log_scales)

    def _log_scales(self, view: Seen, precisions: Array) -> Array:
        log_volumes = self.volume_power * view.log_volumes() if self.volume_power else 0.0
        logarithms = np.log(np.linalg.det(precisions)) + log_volumes
        return np.asarray(self._log_weights + 0.5 * logarithms)

    def _view(self, placed: Placed[Gaussians]) -> Seen:
        if self._frozen:
            return Frozen.of(self._seen_at_start, placed.centres - self._start.centres)
        return seen(placed, self._camera)


def _distinct(values: Array) -> tuple[Array, Indices]:
    """The distinct values, and which of them each value (N,) is; equal ones need no sorting."""
    if (values == values[0]).all():
        return values[:1], np.zeros(len(values), dtype=np.intp)
    distinct, which = np.unique(values, return_inverse=True)
    return distinct, which
