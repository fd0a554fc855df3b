"""Residuals of kernels and terms that compare points with surfaces, and their responses."""

from __future__ import annotations

from abc import abstractmethod
from dataclasses import dataclass
from typing import Any

import numpy as np

from regkit.geometry.rotation import cross
from regkit.interfaces import Response, Similarity
from regkit.observation import Observation
from regkit.primitives import Placed
from regkit.primitives.accumulation import accumulated_residuals
from regkit.registration.robust import Loss
from regkit.system.arrays import Array, Indices


@dataclass(frozen=True)
class Residuals:
    """R residuals between data and primitives, scalar or with D components.

    Attributes:
        owners: Primitive of each residual, (R,).
        values: (R,), or (R, D) for vectors.
        rows: Derivatives to the owner's motion, (R, 6) or (R, D, 6): to its translation, then to a
            rotation vector in the world about its centre.
        weights: Weights of the residuals, (R,).
        constant: Summand of the energy that depends on no residual.
    """

    owners: Indices
    values: Array
    rows: Array
    weights: Array
    constant: float = 0.0

    @property
    def sizes(self) -> Array:
        """Magnitudes of the residuals, (R,): signed values of scalars, norms of vectors."""
        if self.values.ndim == 1:
            return self.values
        return np.asarray(np.sqrt(np.einsum("rd,rd->r", self.values, self.values)))

    def response(self, loss: Loss, count: int, *, curvature: bool) -> Response:
        """Returns the energy ``sum w rho(|r|)``, wrenches (K, 6) and blocks (K, 6, 6).

        The wrenches are exact; the blocks are those of Gauss-Newton with the loss's weights.

        Args:
            loss: The robust loss rho.
            count: Number K of primitives.
            curvature: Whether to return blocks.
        """
        if not len(self.owners):
            blocks = np.zeros((count, 6, 6)) if curvature else None
            return Response(self.constant, np.zeros((count, 6)), blocks)
        wrenches, blocks = accumulated_residuals(*self._weighted(loss), count)
        return Response(self.energy(loss), wrenches, blocks if curvature else None)

    def on_segments(self, loss: Loss, placed: Placed[Any], segments: int) -> Response:
        """Returns the energy, wrenches (S, 6) and blocks (S, 6, 6) about the segments' origins.

        Args:
            loss: The robust loss rho.
            placed: The primitives.
            segments: Number S of segments.
        """
        if not len(self.owners):
            return Response(self.constant, np.zeros((segments, 6)), np.zeros((segments, 6, 6)))
        found = placed.accumulate_residuals(*self._weighted(loss), segments)
        return Response(self.energy(loss), *found)

    def energy(self, loss: Loss) -> float:
        """Returns ``sum w rho(|r|)`` with the constant."""
        return float(self.weights @ loss.values(self.sizes)) + self.constant

    def _weighted(self, loss: Loss) -> tuple[Indices, Array, Array, Array]:
        """Returns owners, values (R, D), rows (R, D, 6) and weights times those of a loss."""
        parts = 1 if self.values.ndim == 1 else self.values.shape[1]
        return (
            self.owners,
            self.values.reshape(-1, parts),
            self.rows.reshape(-1, parts, 6),
            self.weights * loss.weights(self.sizes),
        )


class ResidualSimilarity(Similarity):
    """A robust loss of residuals: a subclass defines the residuals only.

    Args:
        observation: Points and weights of the data.
        loss: Robust loss of a residual.

    Attributes:
        points: The data, (N, 3) [m].
        weights: Weights of the points, (N,), summing to one.
        loss: Robust loss of a residual.
    """

    def __init__(self, observation: Observation, loss: Loss) -> None:
        self.points = observation.points
        self.weights = observation.weights / observation.weights.sum()
        self.loss = loss

    @abstractmethod
    def residuals(self, placed: Placed[Any]) -> Residuals:
        """Returns the residuals of placed primitives; for a kernel one per point, in order."""

    def nearest(
        self, placed: Placed[Any], local: Array, distances: Array, gradients: Array
    ) -> Residuals:
        """Returns the distance of each point to its nearest primitive as a residual.

        Args:
            placed: The primitives in the world.
            local: Points in the primitives' own axes, from ``Placed.local``, (N, K, 3) [m].
            distances: Signed distances of all points to all primitives, (N, K) [m].
            gradients: Their derivatives to the points, in the primitives' own axes, (N, K, 3).
        """
        owners, each = distances.argmin(axis=1), np.arange(len(distances))
        axes = placed.axes[owners]
        normals = (axes @ gradients[each, owners, :, None])[:, :, 0]
        arms = (axes @ local[each, owners, :, None])[:, :, 0]
        rows = -np.concatenate([normals, cross(arms, normals)], axis=1)
        return Residuals(owners, distances[each, owners], rows, self.weights)

    def __call__(self, placed: Placed[Any], *, curvature: bool = False) -> Response:
        """Returns the energy, its exact wrenches and, on request, the Gauss-Newton blocks."""
        return self.residuals(placed).response(self.loss, len(placed), curvature=curvature)

    def on_segments(
        self, placed: Placed[Any], segments: int, *, curvature: bool = False
    ) -> Response:
        """Returns the response on the segments, without sums for each primitive."""
        if self._is_overridden:
            return super().on_segments(placed, segments, curvature=curvature)
        return self.residuals(placed).on_segments(self.loss, placed, segments)

    def energy(self, placed: Placed[Any]) -> float:
        """Returns the energy alone."""
        if self._is_overridden:
            return super().energy(placed)
        return self.residuals(placed).energy(self.loss)

    @property
    def _is_overridden(self) -> bool:
        """Whether a subclass has a response of its own, from which all others follow then."""
        return type(self).__call__ is not ResidualSimilarity.__call__

    def whitened(self, placed: Placed[Any]) -> tuple[Array, Array] | None:
        """Returns the residuals, which the loss bounds, in units of its scale (N, D), and ones."""
        found = self.residuals(placed)
        sizes = found.sizes
        values = found.values.reshape(len(sizes), -1)
        return values * np.sqrt(self.loss.weights(sizes))[:, None], np.ones(len(sizes))

    def inlier_probability(self, placed: Placed[Any]) -> Array | None:
        """Returns the loss's weight of each residual, (N,); None for squares, which accept all."""
        if not np.isfinite(self.loss.tuning):
            return None
        return self.loss.inlier_probability(self.residuals(placed).sizes)
