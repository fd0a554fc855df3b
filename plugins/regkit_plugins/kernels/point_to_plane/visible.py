"""Which surfels a camera sees."""

from __future__ import annotations

import numpy as np

from regkit.primitives import Placed
from regkit.primitives.surfels import Surfels
from regkit.system.arrays import Indices

LEAST_FACING = 0.1
"""Cosine of the angle between normal and line of sight; at the outline there is little to see."""

CELL, THICKNESS = 1.5, 4.0
"""Side of the depth image's cells, and how far behind the nearest surfel in its cell one is hidden,
both in spacings of the surfels: a surface at a slant must not hide itself."""


def visible(placed: Placed[Surfels]) -> Indices:
    """Returns the surfels that face a camera at the origin and are not behind others, (M,).

    They are sorted into the cells of a coarse depth image. Where none is seen, all are.
    """
    centres, depth = placed.centres, placed.centres[:, 2]
    towards = -np.einsum("ki,ki->k", placed.axes[:, :, 2], centres)
    facing = (towards > LEAST_FACING * np.linalg.norm(centres, axis=1)) & (depth > 0.0)
    if not facing.any():
        return np.arange(len(centres))
    seen = np.flatnonzero(facing)
    spacing = 2.0 * float(placed.primitives.scales.mean())
    side = CELL * spacing / float(np.median(depth[seen]))
    cells = np.floor(centres[seen, :2] / (side * depth[seen, None])).astype(np.intp)
    cells -= cells.min(axis=0)
    columns = int(cells[:, 1].max()) + 1
    cell = cells[:, 0] * columns + cells[:, 1]
    nearest = np.full(int(cell.max()) + 1, np.inf)
    np.minimum.at(nearest, cell, depth[seen])
    return np.asarray(seen[depth[seen] < nearest[cell] + THICKNESS * spacing])
