"""Correspondences of data and surfels, and their residuals."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from regkit.clouds.tree import Tree
from regkit.observation import Observation
from regkit.primitives import Placed
from regkit.primitives.surfels import Surfels
from regkit.registration import Loss, Residuals, ResidualSimilarity
from regkit.registration.robust import Squares
from regkit.system.arrays import Array, Indices
from regkit_plugins.kernels.point_to_plane.compiled_pairs import pair_residuals
from regkit_plugins.kernels.point_to_plane.matching import MatchingKernel, given_normals
from regkit_plugins.kernels.point_to_plane.visible import visible


@dataclass(frozen=True)
class Matches:
    """M pairs of data and surfels.

    Attributes:
        points: Indices of the points, (M,).
        surfels: Indices of the surfels, (M,).
        weights: Weights of the pairs, (M,).
        lost: Total weight of the data without a correspondence.
    """

    points: Indices
    surfels: Indices
    weights: Array
    lost: float


class BoundMatching(ResidualSimilarity):
    """A matching kernel bound to a frame.

    The residual r of a pair, with the normal n and the offset q from the surfel to the point, is
    ``r^2 = (1 - t) (n.q)^2 + t |q|^2``.

    Args:
        kernel: The kernel.
        observation: The data.
        start: The surfels in the start pose; surfels hidden there have no correspondences.
        smoothing: Standard deviation that widens the loss [m].
        point_share: t; normals are unused if it is one.
        normals: Normals of the data, (N, 3), which replace those of the surfels.
    """

    def __init__(
        self,
        kernel: MatchingKernel,
        observation: Observation,
        start: Placed[Surfels],
        smoothing: float,
        *,
        point_share: float,
        normals: Array | None = None,
    ) -> None:
        # The scale of the loss may depend on the pairs at the start.
        super().__init__(observation, Squares(1.0))
        self._kernel = kernel
        self._oriented = observation.camera is not None
        self._facing: Array | None = None
        if kernel.angle_deg is not None:
            self._facing = given_normals(observation, "angle_deg")
            if self._oriented:
                away = np.einsum("ni,ni->n", self._facing, self.points) > 0.0
                self._facing = np.where(away[:, None], -self._facing, self._facing)
        self._point_share, self._normals = point_share, normals
        self._visible = visible(start) if self._oriented else np.arange(len(start))
        self._cloud = Tree.of(observation.points) if kernel.reverse_weight > 0.0 else None
        self.loss = self._bound_loss(float(np.sqrt(observation.variances.mean())), start, smoothing)
        self._max_distance = kernel.max_correspondence_distance * self.loss.scale
        self._fixed = self._matched(start) if kernel.matches == "fixed" else None

    def residuals(self, placed: Placed[Surfels]) -> Residuals:
        """Returns ``(sqrt(1 - t) n.q, sqrt(t) q)`` of each pair, and unmatched points' cost."""
        matches = self._matched(placed) if self._fixed is None else self._fixed
        values, rows = pair_residuals(
            self.points,
            np.zeros((0, 3)) if self._normals is None else self._normals,
            placed.centres,
            placed.axes,
            matches.points,
            matches.surfels,
            self._point_share,
        )
        limit = self.loss.values(np.array([self._max_distance]))[0]
        return Residuals(
            matches.surfels, values, rows, matches.weights, float(matches.lost * limit)
        )

    def inlier_probability(self, placed: Placed[Surfels]) -> Array:
        """Returns the loss's weight of each point's residual, (N,); zero without correspondence."""
        found = self._partners(placed)
        offsets, normals = self._offsets(placed, found.points, found.surfels)
        probability = np.zeros(len(self.points))
        probability[found.points] = self.loss.inlier_probability(self._sizes(offsets, normals))
        return probability

    def whitened(self, placed: Placed[Surfels]) -> tuple[Array, Array]:
        """Returns each point's offset from its plane in units of the loss (N, 1), and its share.

        The share is zero without a correspondence. Without planes, the offset is that from the
        surfel, (N, 3). Residuals of surfels to the data are none of the points.
        """
        found = self._partners(placed)
        offsets, normals = self._offsets(placed, found.points, found.surfels)
        if self._point_share < 1.0:
            offsets = np.einsum("mi,mi->m", offsets, normals)[:, None]
        weights = self.loss.weights(np.linalg.norm(offsets, axis=1))
        residuals, shares = (
            np.zeros((len(self.points), offsets.shape[1])),
            np.zeros(len(self.points)),
        )
        residuals[found.points] = np.sqrt(weights)[:, None] * offsets
        shares[found.points] = 1.0
        return residuals, shares

    def _bound_loss(self, deviation: float, start: Placed[Surfels], smoothing: float) -> Loss:
        """Returns the loss for data with a standard deviation [m]."""
        robust, noise = self._kernel.robust, self._kernel.noise
        if robust.scale is None and noise is not None:
            robust = robust.model_copy(update={"scale": noise * deviation})
        residuals = np.zeros(0)
        if robust.scale is None:
            _, nearest = _nearest(self._surface(start), self.points, np.inf)
            offsets_and_normals = self._offsets(
                start, np.arange(len(nearest)), self._visible[nearest]
            )
            residuals = self._sizes(*offsets_and_normals)
        return robust.bound(residuals, least=deviation, smoothing=smoothing)

    def _matched(self, placed: Placed[Surfels]) -> Matches:
        """Returns pairs from data to surfels and, with ``reverse_weight``, from surfels to data."""
        found = self._partners(placed)
        if self._cloud is None:
            return found
        weights = placed.primitives.weights[self._visible]
        weights = self._kernel.reverse_weight * weights / weights.sum()
        distances, points = _nearest(self._cloud, placed.centres[self._visible], self._max_distance)
        near = distances < self._max_distance
        return Matches(
            np.concatenate([found.points, points[near]]),
            np.concatenate([found.surfels, self._visible[near]]),
            np.concatenate([found.weights, weights[near]]),
            found.lost + float(weights[~near].sum()),
        )

    def _partners(self, placed: Placed[Surfels]) -> Matches:
        """Returns the nearest visible surfel of each point within the distance and angle limits."""
        distances, nearest = _nearest(self._surface(placed), self.points, self._max_distance)
        points = np.flatnonzero(distances < self._max_distance)
        surfels = self._visible[nearest[points]]
        if self._facing is not None and self._kernel.angle_deg is not None:
            cosines = (self._facing[points] * placed.axes[surfels, :, 2]).sum(axis=1)
            # Without a camera the orientation of the data's normals is unknown.
            cosines = cosines if self._oriented else np.abs(cosines)
            kept = cosines > np.cos(np.radians(self._kernel.angle_deg))
            points, surfels = points[kept], surfels[kept]
        weights = self.weights[points]
        return Matches(points, surfels, weights, 1.0 - float(weights.sum()))

    def _surface(self, placed: Placed[Surfels]) -> Tree:
        """Returns the tree of the visible surfels."""
        return Tree.of(placed.centres[self._visible])

    def _offsets(
        self, placed: Placed[Surfels], points: Indices, surfels: Indices
    ) -> tuple[Array, Array]:
        """Returns the offsets from surfels to points, (M, 3) [m], and their normals, (M, 3)."""
        offsets = self.points[points] - placed.centres[surfels]
        normals = placed.axes[surfels, :, 2] if self._normals is None else self._normals[points]
        return offsets, normals

    def _sizes(self, offsets: Array, normals: Array) -> Array:
        """Returns the residuals r, (M,) [m]."""
        along = np.einsum("mi,mi->m", offsets, normals)
        squares = np.einsum("mi,mi->m", offsets, offsets)
        return np.asarray(
            np.sqrt((1.0 - self._point_share) * along**2 + self._point_share * squares)
        )


def _nearest(tree: Tree, queries: Array, reach: float) -> tuple[Array, Indices]:
    """Returns distance (Q,) [m] and index (Q,) of the nearest point; infinite and any for none."""
    distances, places = tree.nearest(queries, 1, reach)
    return distances[:, 0], tree.order.take(places[:, 0], mode="clip")
