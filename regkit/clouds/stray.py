"""Stray points: where a cloud has far fewer points than on its surfaces.

Points spread over the box of a cloud occupy as many voxels as its surfaces do, so that a
downsampled cloud would consist of them. The voxels of a surface have many points in their
neighbourhoods and those of stray points few, with hardly any in between; the density of a surface
that is seen from near and far varies without such a gap. Points are therefore stray only if there
is a gap in the cloud's own distribution of densities, and if those below it fill a volume: within
a larger neighbourhood, a sparse surface has fewer of them.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from regkit.clouds.compiled_density import counts_around, dense_points
from regkit.clouds.compiled_voxels import means_in_order, voxel_sums
from regkit.clouds.voxels import sorted_cells, voxel_for
from regkit.system.arrays import Array, Indices

SAMPLE = 20_000
"""Number of points from which the densities of a large cloud are estimated."""

PER_VOXEL = (4.0, 2.0, 1.4)
"""Numbers of points per occupied voxel at which densities are estimated, one after the other until
there is a gap: the more stray points, the finer are the voxels that tell them apart."""

LEAST_RATIO = 3.0
"""A gap separates densities that are at least this factor below the typical one."""

LEAST_SHARE = 0.05
"""Least share of the occupied voxels below a gap."""

DEPTH = 0.6
"""Greatest share of voxels in a gap, relative to the bins on either side of it."""

VOLUME = 3.6
"""Least ratio of the numbers of other points within two voxels and within one: it is 4.6 for points
that fill a volume, and 2.8 for those on a plane."""

FEWEST = 64
"""Fewer voxels than this do not show a distribution."""


def without_stray(points: Array) -> Array:
    """Returns the points (M, 3) that are not stray of a cloud (N, 3) [m], in the same order."""
    sample = np.ascontiguousarray(points[:: max(1, len(points) // SAMPLE)], dtype=float)
    for count in PER_VOXEL:
        voxel = voxel_for(sample, round(len(sample) / count))
        if voxel is None:
            break
        cells, _, counts = voxel_sums(sample, voxel)
        around = counts_around(cells, counts, 1, np.arange(len(cells)))
        least = _gap(cells, counts, around)
        if least > 0.0:
            points = np.ascontiguousarray(points, dtype=float)
            return np.asarray(points[dense_points(points, voxel, cells, counts, around, least)])
    return points


def surface_downsampled(points: Array, voxel: float) -> Array:
    """Returns the mean (M, 3) of the points in each voxel that does not hold stray points.

    The order is that of ``voxel_downsampled``.

    Args:
        points: The cloud, (N, 3) [m].
        voxel: Side of a voxel [m].
    """
    cells, sums, counts = voxel_sums(np.ascontiguousarray(points, dtype=float), voxel)
    dense = dense_voxels(cells, counts)
    order = sorted_cells(cells)
    return means_in_order(sums, counts, order[dense[order]])


def dense_voxels(cells: Array, counts: Indices) -> NDArray[np.bool_]:
    """Returns which occupied voxels (M,) do not hold stray points.

    Args:
        cells: Coordinates of the voxels, (M, 3).
        counts: Numbers of their points, (M,).
    """
    around = counts_around(cells, counts, 1, np.arange(len(cells)))
    return around >= _gap(cells, counts, around)


def _gap(cells: Array, counts: Indices, around: Indices) -> float:
    """Returns the number of points in the gap below which points are stray; 0 if there is none.

    Args:
        cells: Coordinates of the voxels, (M, 3).
        counts: Number of points in each voxel, (M,).
        around: Number of points in each voxel and its neighbours, (M,).
    """
    if len(around) < FEWEST:
        return 0.0
    order = np.argsort(around)
    middle = np.searchsorted(np.cumsum(counts[order]), 0.5 * counts.sum())
    typical = float(around[order][middle])
    # Each bin is a factor of two wide, so that the bins of few points are not empty by themselves.
    levels = np.floor(np.log2(around)).astype(int)
    shares = np.bincount(levels) / len(around)
    depth, gap = DEPTH, 0.0
    for level in range(1, int(np.log2(max(typical / LEAST_RATIO, 1.0))) + 1):
        below, beyond = shares[:level], shares[level + 1 :]
        beside = min(below.max(), beyond.max(initial=0.0))
        if below.sum() >= LEAST_SHARE and shares[level] < depth * beside:
            depth, gap = shares[level] / beside, 2.0 ** (level + 0.5)
    few = np.flatnonzero(around < gap)
    if not len(few):
        return 0.0
    cells, counts, all_few = cells[few], counts[few], np.arange(len(few))
    near, far = (counts_around(cells, counts, reach, all_few) for reach in (1, 2))
    # A point does not count as its own neighbour, which would hide the others where they are few.
    return gap if counts @ (far - 1) >= VOLUME * (counts @ (near - 1)) else 0.0
