"""Pairs of rigid clouds whose true motion is known."""

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
        """Rotation [deg], and how far the source's centre is off, as a part of the size."""
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
    """A pair made of one cloud, turned by an angle [deg] about a random axis, and spoiled.

    Args:
        points: The cloud, (N, 3).
        angle: By how much it is turned [deg].
        seed: Of axis, shift and noise.
        noise: Standard deviation on both clouds, as a part of the size.
        overlap: Which part of each cloud is in the other one too.
        outliers: Which part of each cloud is spread over its box.
    """
    random = np.random.default_rng(seed)
    size = float(np.linalg.norm(np.ptp(points, axis=0)))
    axis, shift, cut = random.normal(size=(3, 3))
    rotation = vector_to_matrix(np.radians(angle) * axis / np.linalg.norm(axis))
    centre = points.mean(axis=0)
    shift *= 0.1 * size / np.linalg.norm(shift)
    truth = rigid(rotation, centre + shift - rotation @ centre)
    # Of each cloud the part ``overlap`` is in the other one too.
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
