"""Small orthographic depth images of spheres and clouds, in compiled loops.

Lengths are in units of the body's size. An image is square, ``2 half`` wide; its cells hold the
depth along z relative to the image's centre, infinite where nothing is.
"""

from __future__ import annotations

from math import floor, isfinite, sqrt

import numpy as np

from regkit.system.arrays import Array, Singles
from regkit.system.compiled import compiled

POOLING = 2
"""Number of cells along each side of a pooled cell of a descriptor."""

DEEPEST = 0.22
"""Depth from the centre beyond which differences count no more in a descriptor [size]."""

BLUR = np.array([0.25, 0.5, 0.25])
"""Weights of a cell and its neighbours along rows and columns, which forgive small offsets."""


@compiled
def empty_image(side: int) -> Array:
    """Returns an image (side, side) that shows nothing."""
    image = np.empty((side, side))
    for row in range(side):
        for column in range(side):
            image[row, column] = np.inf
    return image


@compiled
def spheres_image(centres: Array, radii: Array, middle: Array, half: float, side: int) -> Array:
    """Returns the depth image (side, side) of spheres, seen along z.

    Args:
        centres: Centres of the spheres, (P, 3).
        radii: Their radii, (P,).
        middle: Centre of the image, (3,).
        half: Half the width of the image.
        side: Number of cells along each side.
    """
    image = empty_image(side)
    cell = 2.0 * half / side
    for sphere in range(len(radii)):
        x, y = centres[sphere, 0] - middle[0], centres[sphere, 1] - middle[1]
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
                    depth = centres[sphere, 2] - middle[2]
                    depth -= sqrt(max(radius * radius - square, 0.0))
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
    image = empty_image(side)
    total, count = np.zeros((side, side)), np.zeros((side, side))
    cell = 2.0 * half / side
    for point in range(len(points)):
        x, y, z = points[point, 0], points[point, 1], points[point, 2]
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
            if isfinite(image[row, column]):
                sums[0] += (column + 0.5) * cell - half
                sums[1] += (row + 0.5) * cell - half
                sums[2] += image[row, column]
                count += 1
    for i in range(3):
        sums[i] /= max(count, 1)
    return sums


@compiled
def describe(descriptors: Singles, index: int, image: Array) -> None:
    """Writes the descriptor of an image: pooled and blurred occupancy and depth, (2 n^2,).

    Args:
        descriptors: The descriptors, (N, 2 n^2).
        index: Row of the descriptor.
        image: The image, (side, side), with side = n ``POOLING``.
    """
    side = len(image) // POOLING
    occupancy, depths = np.zeros((side + 2, side + 2)), np.zeros((side + 2, side + 2))
    share = 1.0 / POOLING**2
    for row in range(side * POOLING):
        for column in range(side * POOLING):
            if isfinite(image[row, column]):
                i, j = row // POOLING + 1, column // POOLING + 1
                occupancy[i, j] += share
                depths[i, j] += share * min(max(image[row, column] / DEEPEST, -1.0), 1.0)
    for row in range(side):
        for column in range(side):
            shown, deep = 0.0, 0.0
            for i in range(3):
                for j in range(3):
                    weight = BLUR[i] * BLUR[j]
                    shown += weight * occupancy[row + i, column + j]
                    deep += weight * depths[row + i, column + j]
            descriptors[index, row * side + column] = shown
            descriptors[index, (side + row) * side + column] = deep
