"""Visibility of surfels to a camera."""

from __future__ import annotations

import numpy as np

from regkit.primitives import Placed
from regkit.primitives.surfels import Surfels
from regkit.system.arrays import Indices

LEAST_FACING = 0.1
"""Minimum cosine of the angle between normal and line of sight; the outline is hardly visible."""

CELL, THICKNESS = 1.5, 4.0
"""Size of the depth image's cells, and minimum distance behind the nearest surfel of the cell for a
hidden surfel, in spacings of the surfels; a slanted surface must not hide itself."""


def visible(placed: Placed[Surfels]) -> Indices:
    """Returns the indices (M,) of surfels that face a camera at the origin and are not occluded.

    Occlusion is tested in the cells of a coarse depth image. If no surfel faces the camera, all are
    returned.
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
