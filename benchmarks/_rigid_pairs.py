"""Pairs of rigid clouds with a known relative pose."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from regkit.geometry.rigid import inverse, rigid, transformed
from regkit.geometry.rotation import from_matrix, to_vector, vector_to_matrix
from regkit.system.arrays import Array


@dataclass(frozen=True)
class Pair:
    """Two clouds and T_target_source."""

    source: Array
    target: Array
    truth: Array
    size: float

    def errors(self, transform: Array) -> tuple[float, float]:
        """Returns the errors of rotation [deg] and source's centre, relative to the size."""
        turn = to_vector(from_matrix((inverse(self.truth) @ transform)[:3, :3]))
        centre = self.source.mean(axis=0, keepdims=True)
        off = transformed(transform, centre) - transformed(self.truth, centre)
        return float(np.degrees(np.linalg.norm(turn))), float(np.linalg.norm(off)) / self.size


def bunny(
    points: Array,
    angle: float,
    seed: int,
    *,
    noise: float = 0.0,
    overlap: float = 1.0,
    outliers: float = 0.0,
) -> Pair:
    """Returns a pair from one cloud: rotated about a random axis, and degraded.

    Args:
        points: The cloud, (N, 3).
        angle: Angle of the rotation [deg].
        seed: Seed of axis, translation and noise.
        noise: Standard deviation of the noise on both clouds, relative to the size.
        overlap: Fraction of each cloud that the other one contains too.
        outliers: Fraction of each cloud that is replaced by points spread over its box.
    """
    random = np.random.default_rng(seed)
    size = float(np.linalg.norm(np.ptp(points, axis=0)))
    axis, shift, cut = random.normal(size=(3, 3))
    rotation = vector_to_matrix(np.radians(angle) * axis / np.linalg.norm(axis))
    centre = points.mean(axis=0)
    shift *= 0.1 * size / np.linalg.norm(shift)
    truth = rigid(rotation, centre + shift - rotation @ centre)
    # The fraction ``overlap`` of each cloud is also in the other one.
    order, kept = np.argsort(points @ cut), round(len(points) / (2.0 - overlap))

    def spoiled(cloud: Array) -> Array:
        noisy = cloud + noise * size * random.normal(size=cloud.shape)
        count = round(outliers / (1.0 - outliers) * len(cloud))
        low, high = noisy.min(axis=0), noisy.max(axis=0)
        spread = 0.1 * (high - low)
        return np.concatenate([noisy, random.uniform(low - spread, high + spread, (count, 3))])

    source = spoiled(points[order[:kept]])
    target = spoiled(transformed(truth, points[order[-kept:]]))
    return Pair(source, target, truth, size)
