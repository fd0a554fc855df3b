"""Connected components of depth images and clouds."""

from __future__ import annotations

from itertools import product

import numpy as np
import scipy

from regkit.clouds import spacing
from regkit.observation import Frame
from regkit.system.arrays import Array, Indices

NOISE = 0.003
"""Step between neighbouring pixels that is allowed at a depth of 1 m, beside the gap [m]; steps of
a depth camera grow with the square of the depth."""


SPARSE = 2.0
"""Sides of the cubes of a cloud are at least this many times its spacing."""


def components(frame: Frame, gap: float) -> Indices:
    """Returns the component of each point of a frame, (N,), numbered from 0.

    Points of an image are connected if they are neighbours in the image and their depths differ by
    less than the gap; those of a cloud, if they are in neighbouring cubes of its side.

    Args:
        frame: The frame, with at least one point.
        gap: Distance of components [m].
    """
    pixels = frame.pixels
    if pixels is None or frame.depth is None:
        labels = _of_cloud(frame.points, gap)
    else:
        labels = _of_image(np.nan_to_num(frame.depth), gap).flat[pixels]
    return np.unique(labels, return_inverse=True)[1].ravel()


def _of_image(depth: Array, gap: float) -> Indices:
    """Returns the component of each pixel, (H, W), numbered from 1; 0 without depth."""
    rows, columns = (np.flatnonzero(depth.any(axis=axis)) for axis in (1, 0))
    box = slice(rows[0], rows[-1] + 1), slice(columns[0], columns[-1] + 1)
    inner = depth[box]
    height, width = inner.shape
    # Between the pixels of an image twice as large are their bonds.
    bonds = np.zeros((2 * height - 1, 2 * width - 1), dtype=bool)
    bonds[::2, ::2] = inner > 0.0
    bonds[1::2, ::2] = _bonded(inner[:-1], inner[1:], gap)
    bonds[::2, 1::2] = _bonded(inner[:, :-1], inner[:, 1:], gap)
    found = np.zeros(depth.shape, dtype=np.intp)
    found[box] = scipy.ndimage.label(bonds)[0][::2, ::2]
    return found


def _bonded(first: Array, second: Array, gap: float) -> Array:
    near = np.minimum(first, second)
    return np.asarray((near > 0.0) & (np.abs(first - second) < gap + NOISE * near**2))


def _of_cloud(points: Array, gap: float) -> Indices:
    """Returns the component of each point, (N,), of a cloud (N, 3) [m]."""
    # Points in neighbouring cubes may be two sides apart.
    side = max(0.5 * gap, SPARSE * spacing(points))
    cells = np.floor(points / side).astype(np.int64)
    cells -= cells.min(axis=0) - 1
    _, height, depth = cells.max(axis=0) + 2
    steps = np.array([height * depth, depth, 1])
    # A scene may be large and mostly empty: only occupied cubes are held, by their numbers.
    occupied, cell = np.unique(cells @ steps, return_inverse=True)
    firsts, seconds = [], []
    for step in HALF_AROUND @ steps:
        at = np.searchsorted(occupied, occupied + step)
        at[at == len(occupied)] = 0
        first = np.flatnonzero(occupied[at] == occupied + step)
        firsts.append(first)
        seconds.append(at[first])
    first, second = np.concatenate(firsts), np.concatenate(seconds)
    bonds = scipy.sparse.coo_array(
        (np.ones(len(first), dtype=bool), (first, second)), 2 * (len(occupied),)
    )
    return np.asarray(
        scipy.sparse.csgraph.connected_components(bonds, directed=False)[1][cell.ravel()]
    )


HALF_AROUND = np.array([step for step in product((-1, 0, 1), repeat=3) if step > (0, 0, 0)])
"""Steps (13, 3) to one of each two opposite neighbours of a cube."""
