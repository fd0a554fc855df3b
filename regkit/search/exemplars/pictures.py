"""Pictures of the data: the camera's own, or those of virtual cameras around a whole cloud."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import numpy as np
import scipy

from regkit.geometry.rigid import rigid
from regkit.geometry.rotation import rotation_between
from regkit.observation import Observation
from regkit.search.exemplars.blocks import grid_around, nearest_shown
from regkit.search.exemplars.borders import cutting_borders
from regkit.search.exemplars.images import points_image
from regkit.search.exemplars.model import Grid
from regkit.system.arrays import Array

FAR = 30.0
"""Distance of a virtual camera, in units of the body's size: almost parallel rays."""

CELLS = 56
"""Number of blocks of a virtual picture along each side."""

WIDTH = 1.8
"""Width of a virtual picture, in units of the body's size."""

SAMPLE = 200
"""Number of points that show the spacing of neighbours."""


@dataclass(frozen=True)
class Picture:
    """The data, seen by a camera.

    Attributes:
        T_camera_world: Pose of the camera, (4, 4).
        grid: The data as the camera sees them.
        rotation: R_view_world, whose z axis is the direction in which the data are seen, (3, 3).
        borders: Outward unit normals in the world of the picture's borders that cut the data off,
            (B, 3), the one of the longest contact first.
    """

    T_camera_world: Array
    grid: Grid
    rotation: Array
    borders: Array


@dataclass(frozen=True)
class Pictures:
    """All pictures of a frame.

    Attributes:
        points: The data in the world, (N, 3) [m].
        pictures: The pictures.
        one_sided: Whether the data show only the side that faces a camera.
    """

    points: Array
    pictures: tuple[Picture, ...]
    one_sided: bool

    @classmethod
    def of(cls, observation: Observation, size: float) -> Pictures:
        """Returns the pictures of a frame: one of a camera, three of a cloud without one.

        Args:
            observation: The frame; without a camera, its points are the whole surface.
            size: Usual size of the body [m].
        """
        points, camera, depth = observation.points, observation.camera, observation.depth
        middle = points.mean(axis=0)
        if camera is not None and depth is not None:
            towards = rotation_between(middle / np.linalg.norm(middle), np.array([0.0, 0.0, 1.0]))
            grid = grid_around(camera, depth, points)
            borders = cutting_borders(camera, depth, points)
            return cls(points, (Picture(np.eye(4), grid, towards, borders),), one_sided=True)
        if camera is not None:
            return cls(points, (_projected(points, size),), one_sided=True)
        views = [np.roll(np.eye(3), turn, axis=0) for turn in range(3)]
        spread = 0.75 * _spacing(points)
        pictures = [_virtual(points - middle, middle, view, size, spread) for view in views]
        return cls(points, tuple(pictures), one_sided=False)

    @property
    def area(self) -> float:
        """Area of the data, as if all faced the camera [m^2]; the least of all pictures."""
        return min(_area(picture.grid) for picture in self.pictures)

    @property
    def cut(self) -> bool:
        """Whether a border of a picture cuts the data off."""
        return any(len(picture.borders) for picture in self.pictures)

    @cached_property
    def spread(self) -> float:
        """Half the distance of neighbouring points, with some overlap [m]."""
        return 0.75 * _spacing(self.points)


def _area(grid: Grid) -> float:
    """Returns the area of a picture's data [m^2]."""
    depths = grid.depth[np.isfinite(grid.depth) & (grid.depth > 0.0)]
    return float((depths**2).sum() / (grid.intrinsics[0] * grid.intrinsics[1]))


def _projected(points: Array, size: float) -> Picture:
    """Returns the picture of the points of a camera whose image is not known.

    Where no point is, space is free; where the image ends is unknown.
    """
    middle = points.mean(axis=0)
    ray = middle / middle[2]
    # In the plane through the middle the image is to scale, so that blocks have the size of cells.
    offsets = points / points[:, 2:] * middle[2] - ray * middle[2]
    flat = np.column_stack([offsets[:, :2], points[:, 2]])
    cell = WIDTH * size / CELLS
    spread = max(0.75 * _spacing(points), 0.5 * cell)
    image = points_image(flat, spread, 0.5 * WIDTH * size, CELLS, False)
    focal, centre = middle[2] / cell, 0.5 * (CELLS - 1)
    intrinsics = np.array([focal, focal, *(centre - focal * ray[:2])])
    towards = rotation_between(middle / np.linalg.norm(middle), np.array([0.0, 0.0, 1.0]))
    grid = Grid(image, nearest_shown(image), intrinsics)
    return Picture(np.eye(4), grid, towards, np.zeros((0, 3)))


def _virtual(around: Array, middle: Array, view: Array, size: float, spread: float) -> Picture:
    """Returns the picture of a cloud around its middle by a far camera."""
    cell, distance = WIDTH * size / CELLS, FAR * size
    image = points_image(around @ view.T, max(spread, 0.5 * cell), 0.5 * WIDTH * size, CELLS, True)
    centre = 0.5 * (CELLS - 1)
    focal = distance / cell
    intrinsics = np.array([focal, focal, centre, centre])
    grid = Grid(image + distance, nearest_shown(image + distance), intrinsics)
    return Picture(
        rigid(view, np.array([0.0, 0.0, distance]) - view @ middle), grid, view, np.zeros((0, 3))
    )


def _spacing(points: Array) -> float:
    """Returns the median distance of neighbouring points [m]."""
    some = points[:: max(1, len(points) // SAMPLE)]
    if len(points) < 2:
        return 0.0
    distances = np.asarray(scipy.spatial.KDTree(points).query(some, k=2)[0])
    return float(np.median(distances[:, 1]))
