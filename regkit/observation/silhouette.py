"""What a depth image says of free space: nothing is beside what it shows, or before it."""

from __future__ import annotations

import numpy as np

from regkit.geometry.camera import Camera
from regkit.observation.free_space import free_space_distances
from regkit.system.arrays import Array

COLUMNS = 88
"""The image is looked at in blocks, about so many in a row: outlines need no more."""

HALF = 0.75
"""What is so many blocks from the middle of one that shows something is not beside it."""


class Silhouette:
    """A depth image in blocks.

    Args:
        camera: The camera.
        depth: (H, W) [m], zero where nothing was measured, which is taken as seen through.
    """

    def __init__(self, camera: Camera, depth: Array) -> None:
        side = max(1, round(camera.width / COLUMNS))
        rows, columns = camera.height // side, camera.width // side
        measured = np.where(depth > 0.0, depth, np.inf)[: rows * side, : columns * side]
        strips = measured.reshape(rows, side, -1).min(axis=1)
        self._nearest = strips.T.reshape(columns, side, rows).min(axis=1)
        self._half = HALF * side / camera.fx
        self._scale = np.array([camera.fx, camera.fy]) / side
        middle = 0.5 * (side - 1)
        self._offset = (np.array([camera.cx, camera.cy]) - middle) / side
        self._shown = (np.argwhere(np.isfinite(self._nearest)) - self._offset) / self._scale

    def distances(self, points: Array, margins: Array) -> tuple[Array, Array]:
        """How far points are in free space, (M,) [m], and the derivative of it, (M, 3).

        Beside the silhouette it is the way to the nearest block that shows something, across the
        line of sight; before it the way to the least depth there, less a margin, along z.

        Args:
            points: In the camera's frame, (M, 3) [m].
            margins: How far before the measured depth each of them may be, (M,) [m].
        """
        return free_space_distances(
            points, margins, self._nearest, self._shown, self._scale, self._offset, self._half
        )
