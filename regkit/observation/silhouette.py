"""Free space of a depth image: outside the silhouette, and in front of the measured depth."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from regkit.geometry.camera import Camera
from regkit.observation.free_space import free_space_distances
from regkit.system.arrays import Array

COLUMNS = 88
"""Approximate number of block columns; outlines need no higher resolution."""

HALF = 0.75
"""A ray within this many blocks of the centre of a block with depth is inside the silhouette."""

NEAREST = 1e-3
"""Points nearer than this are projected as if they were as far [m]."""


class Silhouette:
    """A depth image reduced to blocks of pixels.

    Args:
        camera: Intrinsics of the image.
        depth: Depth image, (H, W) [m]; zero marks an invalid pixel, which counts as free space. NaN
            marks an unknown pixel; a block with one and without depth is neither free nor occupied.
    """

    def __init__(self, camera: Camera, depth: Array) -> None:
        side = max(1, round(camera.width / COLUMNS))
        rows, columns = camera.height // side, camera.width // side
        depth = depth[: rows * side, : columns * side]
        self._nearest = _block_minima(np.where(depth > 0.0, depth, np.inf), side)
        if (unknown := np.isnan(depth)).any():
            # Everything is behind an unknown block, as if it had the depth zero.
            hiding = np.isfinite(_block_minima(np.where(unknown, 0.0, np.inf), side))
            self._nearest[hiding & np.isinf(self._nearest)] = 0.0
        self._half = HALF * side / camera.fx
        self._scale = np.array([camera.fx, camera.fy]) / side
        middle = 0.5 * (side - 1)
        self._offset = (np.array([camera.cx, camera.cy]) - middle) / side
        shown = (np.argwhere(np.isfinite(self._nearest)) - self._offset) / self._scale
        self._shown = np.ascontiguousarray(shown)

    def distances(self, points: Array, margins: Array) -> tuple[Array, Array]:
        """Returns how far points are inside free space, (M,) [m], and the gradients, (M, 3).

        Nothing is known beyond the picture, so points there are not in free space. Outside the
        silhouette this is the distance to the nearest block with depth, perpendicular to the
        optical axis. Inside it is the distance along z to the block's minimum depth less the
        margin.

        Args:
            points: Points in the camera frame, (M, 3) [m].
            margins: Allowed distance of each point in front of the measured depth, (M,) [m].
        """
        return free_space_distances(points, margins, *self.arrays)

    @property
    def arrays(self) -> tuple[Array, Array, Array, Array, float]:
        """The last arguments of ``free_space_distances``."""
        return self._nearest, self._shown, self._scale, self._offset, self._half

    def observable(self, points: Array, margins: Array | float = np.inf) -> NDArray[np.bool_]:
        """Returns which points (M,) the image would show if something were there.

        These are the points inside the picture, on no unknown block, and not hidden by what the
        image shows in front of them.

        Args:
            points: Points in the camera frame, (M, 3) [m].
            margins: Distance behind the measured depth from which on a point is hidden, (M,) or for
                all points [m]; by default none is.
        """
        depth = np.maximum(points[:, 2:], NEAREST)
        blocks = np.rint(points[:, :2] / depth * self._scale + self._offset)
        size = np.array(self._nearest.shape)
        inside = ((blocks >= 0) & (blocks < size)).all(axis=1) & (points[:, 2] > 0.0)
        column, row = np.clip(blocks, 0, size - 1).astype(int).T
        nearest = self._nearest[column, row]
        return np.asarray(inside & (nearest > 0.0) & (points[:, 2] - margins <= nearest))


def _block_minima(image: Array, side: int) -> Array:
    """Returns the minima of the blocks of an image, (columns, rows)."""
    rows, columns = image.shape[0] // side, image.shape[1] // side
    strips = image.reshape(rows, side, -1).min(axis=1)
    return np.ascontiguousarray(strips.T.reshape(columns, side, rows).min(axis=1))
