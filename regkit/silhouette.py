"""What a depth image says of free space: nothing is beside what it shows, or before it."""

from __future__ import annotations

import numpy as np

from regkit.arrays import Array
from regkit.camera import Camera

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

    def gaps(self, points: Array, margins: Array) -> tuple[Array, Array]:
        """How far points are in free space, (M,) [m], and the derivative of it, (M, 3).

        Beside the silhouette it is the way to the nearest block that shows something, across the
        line of sight; before it the way to the least depth there, less a margin, along z.

        Args:
            points: In the camera's frame, (M, 3) [m].
            margins: How far before the measured depth each of them may be, (M,) [m].
        """
        gaps, slopes = np.zeros(len(points)), np.zeros_like(points)
        if not len(self._shown):
            return gaps, slopes
        z = np.maximum(points[:, 2], 1e-3)
        rays = points[:, :2] / z[:, None]
        depths = self._depths(rays)
        before = depths - margins - points[:, 2]
        inside = np.isfinite(depths) & (before > 0.0)
        gaps[inside] = before[inside]
        slopes[inside, 2] = -1.0
        beside = np.flatnonzero(~np.isfinite(depths))
        if len(beside):
            gaps[beside], slopes[beside] = self._beside(rays[beside], z[beside])
        return gaps, slopes

    def _beside(self, rays: Array, z: Array) -> tuple[Array, Array]:
        """The gaps z (|p_xy / z - ray| - half) of points beside the silhouette; their slopes."""
        offsets = rays[:, None, :] - self._shown
        nearest = (offsets**2).sum(axis=2).argmin(axis=1)
        away = offsets[np.arange(len(rays)), nearest]
        distances = np.linalg.norm(away, axis=1)
        away /= distances[:, None]
        over = distances - self._half
        slopes = np.column_stack([away, over - (away * rays).sum(axis=1)])
        return z * np.maximum(over, 0.0), slopes * (over > 0.0)[:, None]

    def _depths(self, rays: Array) -> Array:
        """The least depth measured in the block of each ray, (M,) [m]; inf where there is none."""
        block = np.rint(rays * self._scale + self._offset).astype(np.intp)
        inside = ((block >= 0) & (block < self._nearest.shape)).all(axis=1)
        depths = np.full(len(rays), np.inf)
        depths[inside] = self._nearest[block[inside, 0], block[inside, 1]]
        return depths
