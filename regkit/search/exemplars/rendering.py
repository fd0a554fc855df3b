"""Disagreement of rendered bodies with a block image, in compiled loops."""

from __future__ import annotations

from math import ceil, floor, isfinite, sqrt

import numpy as np

from regkit.search.exemplars.model import Grid, Spheres
from regkit.search.exemplars.pulls import placed_point
from regkit.system.arrays import Array, Indices
from regkit.system.compiled import compiled

OUTSIDE = 0.3
"""Cost of a block that only the body covers, beyond the picture, where there are no data."""

NEAREST = 0.05
"""A body closer to the camera than this [m] is not rendered."""


@compiled
def disagreements(
    links: Array,
    segment_links: Indices,
    spheres: Spheres,
    grid: Grid,
    tolerance: float,
) -> Array:
    """Returns the disagreement (N,) of posed bodies with a block image, from 0 to 1.

    It is the mean over all blocks that show the data or the body: the depth difference in units of
    the tolerance, at most 1, or 1 where only one of them is. Where optional spheres show, the data
    may be what is behind them.

    Args:
        links: T_camera_link of each body, (N, L, 4, 4).
        segment_links: Link of each segment, (S,).
        spheres: Spheres on the body's axes.
        grid: The data.
        tolerance: Depth difference that counts as none agreeing [m].
    """
    segments, points, radii, optional = spheres
    blocks, _, intrinsics = grid
    fx, fy, cx, cy = intrinsics
    rows, columns = blocks.shape
    means = np.empty(len(links))
    # The first image shows the spheres that must show, the second the optional ones.
    images = np.empty((2, rows, columns))
    for body in range(len(links)):
        for image in range(2):
            for row in range(rows):
                for column in range(columns):
                    images[image, row, column] = np.inf
        behind = False
        for sphere in range(len(radii)):
            x, y, z = placed_point(links[body, segment_links[segments[sphere]]], points[sphere])
            if z < NEAREST:
                behind = True
                break
            image = 1 if optional[sphere] else 0
            u, v, width = fx * x / z + cx, fy * y / z + cy, max(fx * radii[sphere] / z, 0.5)
            for row in range(max(0, ceil(v - width)), min(rows - 1, floor(v + width)) + 1):
                for column in range(
                    max(0, ceil(u - width)), min(columns - 1, floor(u + width)) + 1
                ):
                    square = ((row - v) ** 2 + (column - u) ** 2) / (width * width)
                    if square <= 1.0:
                        depth = z - radii[sphere] * sqrt(1.0 - square)
                        images[image, row, column] = min(images[image, row, column], depth)
        if behind:
            means[body] = 1.0
            continue
        total, count = 0.0, 0
        for row in range(rows):
            for column in range(columns):
                seen, shown = blocks[row, column], images[0, row, column]
                if isfinite(seen) and abs(seen - images[1, row, column]) < abs(seen - shown):
                    shown = images[1, row, column]
                if isfinite(seen) and seen >= 0.0:
                    total += min(abs(seen - shown) / tolerance, 1.0)
                    count += 1
                elif isfinite(shown):
                    total += OUTSIDE if seen < 0.0 else 1.0
                    count += 1
        means[body] = total / max(count, 1)
    return means
