"""Small orthographic depth images of spheres and clouds, in compiled loops.

Lengths are in units of the body's size. An image is square, ``2 half`` wide; its cells hold the
depth along z relative to the image's centre, infinite where nothing is.
"""

from __future__ import annotations

from math import floor, sqrt

import numpy as np

from regkit.system.arrays import Array, Singles
from regkit.system.compiled import compiled

BLUR = np.array([0.25, 0.5, 0.25])
"""Weights of a cell and its neighbours along rows and columns, which forgive small offsets."""


@compiled
def spheres_image(centres: Array, radii: Array, half: float, side: int) -> Array:
    """Returns the depth image (side, side) of spheres, seen along z.

    Args:
        centres: Centres of the spheres relative to the image's centre, (P, 3).
        radii: Their radii, (P,).
        half: Half the width of the image.
        side: Number of cells along each side.
    """
    image = np.full((side, side), np.inf)
    cell = 2.0 * half / side
    for sphere in range(len(radii)):
        x, y, z = centres[sphere]
        radius = radii[sphere]
        # A sphere thinner than a cell still shows.
        shown = max(radius, 0.6 * cell)
        for row in range(
            max(0, floor((y - shown + half) / cell)),
            min(side - 1, floor((y + shown + half) / cell)) + 1,
        ):
            down = (row + 0.5) * cell - half - y
            for column in range(
                max(0, floor((x - shown + half) / cell)),
                min(side - 1, floor((x + shown + half) / cell)) + 1,
            ):
                right = (column + 0.5) * cell - half - x
                square = right * right + down * down
                if square <= shown * shown:
                    depth = z - sqrt(max(radius * radius - square, 0.0))
                    image[row, column] = min(image[row, column], depth)
    return image


@compiled
def points_image(points: Array, spread: float, half: float, side: int, nearest: bool) -> Array:
    """Returns the depth image (side, side) of points, each a square of width ``2 spread``.

    Args:
        points: Points relative to the image's centre, (N, 3).
        spread: Half the distance of neighbouring points.
        half: Half the width of the image.
        side: Number of cells along each side.
        nearest: Whether a cell shows its nearest point, for clouds with a far side; otherwise it
            shows the mean of its points.
    """
    image = np.full((side, side), np.inf)
    total, count = np.zeros((side, side)), np.zeros((side, side))
    cell = 2.0 * half / side
    for point in range(len(points)):
        x, y, z = points[point]
        for row in range(
            max(0, floor((y - spread + half) / cell)),
            min(side - 1, floor((y + spread + half) / cell)) + 1,
        ):
            for column in range(
                max(0, floor((x - spread + half) / cell)),
                min(side - 1, floor((x + spread + half) / cell)) + 1,
            ):
                total[row, column] += z
                count[row, column] += 1.0
                image[row, column] = min(image[row, column], z)
    if not nearest:
        for row in range(side):
            for column in range(side):
                if count[row, column] > 0.0:
                    image[row, column] = total[row, column] / count[row, column]
    return image


@compiled
def image_centre(image: Array, half: float) -> Array:
    """Returns the mean position (3,) of the cells that show something."""
    side = len(image)
    cell = 2.0 * half / side
    sums, count = np.zeros(3), 0
    for row in range(side):
        for column in range(side):
            if np.isfinite(image[row, column]):
                sums[0] += (column + 0.5) * cell - half
                sums[1] += (row + 0.5) * cell - half
                sums[2] += image[row, column]
                count += 1
    return sums / max(count, 1)


@compiled
def offset_of_share(image: Array, half: float, normal: Array, share: float) -> float:
    """Returns the distance from the centre of the line that leaves a share of the cells shown.

    Args:
        image: The image.
        half: Half the width of the image.
        normal: Outward unit vector of the line in the image, (2,).
        share: Share of the cells that show something, from 0 to 1.
    """
    side = len(image)
    cell = 2.0 * half / side
    heights, count = np.empty(side * side), 0
    for row in range(side):
        for column in range(side):
            if np.isfinite(image[row, column]):
                x, y = (column + 0.5) * cell - half, (row + 0.5) * cell - half
                heights[count] = normal[0] * x + normal[1] * y
                count += 1
    if not count:
        return 0.0
    return float(np.quantile(heights[:count], share))


@compiled
def cut_image(image: Array, half: float, normal: Array, offset: float) -> None:
    """Empties the cells beyond the line ``normal . (x, y) = offset``, in place.

    Args:
        image: The image.
        half: Half the width of the image.
        normal: Unit vector in the image, (2,).
        offset: Distance of the line from the image's centre.
    """
    side = len(image)
    cell = 2.0 * half / side
    for row in range(side):
        for column in range(side):
            x, y = (column + 0.5) * cell - half, (row + 0.5) * cell - half
            if normal[0] * x + normal[1] * y > offset:
                image[row, column] = np.inf


@compiled
def described(image: Array, pooling: int, deepest: float) -> Singles:
    """Returns the descriptor of an image: pooled and blurred occupancy and depth, (2 n^2,).

    Args:
        image: The image, (side, side).
        pooling: Number of cells along each side of a pooled cell; side = n pooling.
        deepest: Depth beyond which differences count no more.
    """
    side = len(image) // pooling
    occupancy, depths = np.zeros((side + 2, side + 2)), np.zeros((side + 2, side + 2))
    share = 1.0 / pooling**2
    for row in range(side * pooling):
        for column in range(side * pooling):
            depth = image[row, column]
            if np.isfinite(depth):
                occupancy[row // pooling + 1, column // pooling + 1] += share
                bounded = min(max(depth / deepest, -1.0), 1.0)
                depths[row // pooling + 1, column // pooling + 1] += share * bounded
    descriptor = np.empty(2 * side * side, dtype=np.float32)
    for row in range(side):
        for column in range(side):
            shown = deep = 0.0
            for i in range(3):
                for j in range(3):
                    weight = BLUR[i] * BLUR[j]
                    shown += weight * occupancy[row + i, column + j]
                    deep += weight * depths[row + i, column + j]
            descriptor[row * side + column] = shown
            descriptor[side * side + row * side + column] = deep
    return descriptor
