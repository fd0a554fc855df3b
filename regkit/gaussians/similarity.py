"""Base class of kernels that compare Gaussians: a kernel defines only the weights of pairs."""

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
    """Data of one variance [m^2]: their weights (N,), and log_scale (K,) in the start pose."""

    variance: float
    weights: Array
    pairs: Pairs
    log_scales: Array


class GaussianSimilarity(Similarity):
    """An energy of the densities exp(log_scale - 1/2 q^T P q) of all pairs, with q = y - m.

    P is the inverse of the sum of the model's and the data's covariance. A kernel defines the
    energy of the densities and the weight of each pair: the energy's derivative is the sum over
    the pairs of weight times the derivative of 1/2 q^T P q - log_scale. Everything else follows
    from the moments of the data under these weights. Data of different variances form groups.

    Args:
        observation: Points, variances and camera of the data.
        start: Primitives in the start pose.
        data_weights: Weights of the points, (N,), summing to one.
        log_weights: Logarithms of the primitives' weights, (K,), a summand of log_scale.
        smoothing: Standard deviation of the Gaussian that smooths the data [m].
        frozen: Whether covariances keep their orientation of the start pose.
    """

    volume_power: ClassVar[float]
    """Coefficient of 1/2 log |C| in log_scale, which also contains 1/2 log |P|."""

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
        self._points = points
        variances, self._group_of = _distinct(observation.variances)
        self._groups = [
            self._group(float(variance) + smoothing**2, points[own], data_weights[own])
            for variance, own in ((v, self._group_of == g) for g, v in enumerate(variances))
        ]

    @abstractmethod
    def weigh(self, densities: Array, data_weights: Array) -> float | None:
        """Returns the energy and turns the densities into the weights of the pairs, in place.

        Args:
            densities: (K, N), multiplied by the data weights; overwritten with the weights.
            data_weights: (N,).

        Returns:
            The energy, or None for minus the sum of the weights, which the moments contain.
        """

    @abstractmethod
    def inliers(self, densities: Array, data_weights: Array) -> Array:
        """Returns the probability that each point is an inlier, (N,), from 0 to 1.

        Args:
            densities: (K, N), multiplied by the data weights.
            data_weights: (N,).
        """

    def inlier_probability(self, placed: Placed[Gaussians]) -> Array:
        """Returns the probability (N,) that each point is an inlier, from 0 to 1."""
        view = self._view(placed)
        probability = np.empty(len(self._group_of))
        for index, group in enumerate(self._groups):
            densities, _ = self._densities(group, view)
            probability[self._group_of == index] = self.inliers(densities, group.weights)
        return probability

    def whitened(self, placed: Placed[Gaussians]) -> tuple[Array, Array] | None:
        """Returns the points' offsets from the Gaussians in their own units (N, 3), and inliers.

        An offset is the mean of R^T (y - m), with R R^T = P, over the Gaussians that the point may
        belong to.
        """
        view = self._view(placed)
        offsets, inliers = np.empty((len(self._group_of), 3)), np.empty(len(self._group_of))
        for index, group in enumerate(self._groups):
            own = self._group_of == index
            densities, precisions = self._densities(group, view)
            shares = densities / np.maximum(densities.sum(axis=0), np.finfo(float).tiny)
            probability = self.inliers(densities, group.weights)
            shares *= probability
            factors = np.linalg.cholesky(precisions)
            turned = self._points[own] @ factors
            turned -= (view.means - self._centre)[:, None] @ factors
            offsets[own] = np.einsum("kn,kni->ni", shares, turned)
            inliers[own] = probability
        return offsets, inliers

    def __call__(self, placed: Placed[Gaussians], *, curvature: bool = False) -> Response:
        """Returns the energy, wrenches about the primitives' centres, and Gauss-Newton blocks."""
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
        """Returns the contribution of the data of one variance."""
        densities, precisions = self._densities(group, view)
        energy = self.weigh(densities, group.weights)
        moments = group.pairs.moments(densities, precisions)
        return Response(
            energy=-float(moments.mass.sum()) if energy is None else energy,
            wrenches=view.wrenches(moments, self.volume_power),
            stiffness=None if levers is None else moments.stiffness(levers),
        )

    def _densities(self, group: _Group, view: Seen) -> tuple[Array, Array]:
        """Returns densities (K, N) and precisions (K, 3, 3) for the data of one variance."""
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
    """Returns the distinct values and each value's index (N,) among them; skips a needless sort."""
    if (values == values[0]).all():
        return values[:1], np.zeros(len(values), dtype=np.intp)
    distinct, which = np.unique(values, return_inverse=True)
    return distinct, which
