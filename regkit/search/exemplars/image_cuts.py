"""Lines that cut off a part of an image, in compiled loops."""

from __future__ import annotations

from math import floor, isfinite

import numpy as np

from regkit.system.arrays import Array
from regkit.system.compiled import compiled


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
            if isfinite(image[row, column]):
                x, y = (column + 0.5) * cell - half, (row + 0.5) * cell - half
                heights[count] = normal[0] * x + normal[1] * y
                count += 1
    if not count:
        return 0.0
    # The quantile lies between two neighbours in the order of the heights.
    position = share * (count - 1)
    rank = floor(position)
    lower = ranked(heights, count, rank)
    if rank == count - 1:
        return lower
    return lower + (position - rank) * (ranked(heights, count, rank + 1) - lower)


@compiled
def ranked(values: Array, count: int, rank: int) -> float:
    """Returns the value of a rank, from 0, among the first ``count`` values; reorders them.

    Source: Hoare's selection, C. A. R. Hoare, Algorithm 65: Find, Communications of the ACM 4(7),
    1961.
    """
    first, last = 0, count - 1
    while first < last:
        pivot = values[rank]
        low, high = first, last
        while low <= high:
            while values[low] < pivot:
                low += 1
            while pivot < values[high]:
                high -= 1
            if low <= high:
                values[low], values[high] = values[high], values[low]
                low += 1
                high -= 1
        if high < rank:
            first = low
        if rank < low:
            last = high
    return float(values[rank])


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
