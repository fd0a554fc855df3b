"""Clusters of points, one per fitted solid."""

from __future__ import annotations

import numpy as np

from regkit.system.arrays import Array, Indices


def clusters(points: Array, centres: Array, in_plane: int = 0) -> Indices:
    """Returns the cluster (N,) of each point by Lloyd's k-means.

    Source: Lloyd, Least squares quantization in PCM, IEEE Trans. Inf. Theory 28, 1982.

    Args:
        points: (N, 3) [m].
        centres: Initial centres, (K, 3) [m].
        in_plane: Number of last centres that stay in the plane x = 0.
    """
    centres = centres.copy()
    kept = slice(len(centres) - in_plane, len(centres))
    for _ in range(200):
        centres[kept, 0] = 0.0
        owners = ((points[:, None] - centres) ** 2).sum(axis=2).argmin(axis=1)
        moved = centres.copy()
        for index in np.unique(owners):
            moved[index] = points[owners == index].mean(axis=0)
        moved[kept, 0] = 0.0
        if np.abs(moved - centres).max() < 1e-7:
            break
        centres = moved
    return np.asarray(owners)


def spread(points: Array, count: int) -> Indices:
    """Returns the indices (K,) of ``count`` points chosen by farthest-point sampling."""
    chosen = [int(((points - points.mean(axis=0)) ** 2).sum(axis=1).argmax())]
    distances = ((points - points[chosen[0]]) ** 2).sum(axis=1)
    while len(chosen) < count:
        chosen.append(int(distances.argmax()))
        distances = np.minimum(distances, ((points - points[chosen[-1]]) ** 2).sum(axis=1))
    return np.array(chosen)
