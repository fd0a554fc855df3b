"""Free space of a depth image: outside the silhouette, and in front of the measured depth."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from regkit.geometry.camera import Camera
from regkit.observation.compiled_blocks import block_depths, observable_points
from regkit.observation.free_space import free_space_distances
from regkit.system.arrays import Array, Indices, loop_input

COLUMNS = 88
"""Approximate number of block columns; outlines need no higher resolution."""

HALF = 0.75
"""A ray within this many blocks of the centre of a block with depth is inside the silhouette."""


class Silhouette:
    """A depth image reduced to blocks of pixels.

    Args:
        camera: Intrinsics of the image.
        depth: Depth image, (H, W) [m]; zero marks an invalid pixel, which counts as free space. NaN
            marks an unknown pixel; a block with one and without depth is neither free nor occupied.
    """

    def __init__(self, camera: Camera, depth: Array) -> None:
        side = max(1, round(camera.width / COLUMNS))
        self._nearest, self._shown = block_depths(loop_input(depth), side)
        self._half = HALF * side / camera.fx
        self._scale = np.array([camera.fx, camera.fy]) / side
        middle = 0.5 * (side - 1)
        self._offset = (np.array([camera.cx, camera.cy]) - middle) / side

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
        return free_space_distances(loop_input(points), loop_input(margins), *self.arrays)

    @property
    def arrays(self) -> tuple[Array, Indices, Array, Array, float]:
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
        each = np.full(len(points), margins, dtype=np.float64)
        return observable_points(loop_input(points), each, self._nearest, self._scale, self._offset)
