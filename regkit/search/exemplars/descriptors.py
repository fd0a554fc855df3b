"""Descriptors of exemplars and clouds: what their small depth images show, centred."""

from __future__ import annotations

import numpy as np

from regkit.search.exemplars.image_cuts import cut_image, offset_of_share
from regkit.search.exemplars.images import (
    POOLING,
    describe,
    image_centre,
    points_image,
    spheres_image,
)
from regkit.system.arrays import Array, Singles
from regkit.system.compiled import compiled

SIDE = 48
"""Number of cells along each side of an image."""

HALF, WIDE = 0.68, 0.782
"""Half the width of an image, and of the wider one that finds its centre [size]."""


@compiled
def there(
    places: Array, radii: Array, far: Array, view: Array, reach: float
) -> tuple[Array, Array]:
    """Returns the centres (Q, 3) and radii (Q,) of the spheres of a body that are there, in a view.

    Args:
        places: Centres of its spheres, (P, 3) [size].
        radii: Radii of the spheres, (P,) [size].
        far: How far each sphere is along a part that the data may lack, (P,) [size]; else 0.
        view: R_view_body, (3, 3).
        reach: How far the parts that the data may lack are there [size].
    """
    count = 0
    for sphere in range(len(radii)):
        count += 1 if far[sphere] <= reach else 0
    seen, thick = np.zeros((count, 3)), np.empty(count)
    row = 0
    for sphere in range(len(radii)):
        if far[sphere] > reach:
            continue
        thick[row] = radii[sphere]
        for i in range(3):
            for j in range(3):
                seen[row, i] += view[i, j] * places[sphere, j]
        row += 1
    return seen, thick


@compiled
def mean_place(points: Array) -> Array:
    """Returns the mean (3,) of points (N, 3)."""
    mean = np.zeros(3)
    for point in range(len(points)):
        for i in range(3):
            mean[i] += points[point, i] / len(points)
    return mean


@compiled
def exemplar_descriptors(
    places: Array, radii: Array, far: Array, views: Array, cuts: Array, reaches: Array
) -> tuple[Singles, Array]:
    """Returns the descriptors (N, D) of posed bodies, and the centres of their images (N, 3).

    Args:
        places: Centres of spheres on the bodies' axes, (N, P, 3) [size].
        radii: Radii of the spheres, (P,) [size].
        far: How far each sphere is along a part that the data may lack, (P,) [size]; else 0.
        views: R_view_body, (N, 3, 3).
        cuts: Lines at which the picture ends: outward direction, and share of the remaining image
            that is in view, (N, C, 3). A line with the share 1 cuts nothing off.
        reaches: How far the parts that the data may lack are there, (N,) [size].
    """
    descriptors = np.empty((len(places), 2 * (SIDE // POOLING) ** 2), dtype=np.float32)
    centres, offsets = np.empty((len(places), 3)), np.empty(cuts.shape[1])
    for index in range(len(places)):
        seen, thick = there(places[index], radii, far, views[index], reaches[index])
        middle = mean_place(seen)
        image = spheres_image(seen, thick, middle, WIDE, SIDE)
        for line in range(len(offsets)):
            offsets[line], share = np.inf, cuts[index, line, 2]
            if share < 1.0:
                offsets[line] = offset_of_share(image, WIDE, cuts[index, line], share)
                cut_image(image, WIDE, cuts[index, line], offsets[line])
        shift = image_centre(image, WIDE)
        for i in range(3):
            middle[i] += shift[i]
            centres[index, i] = middle[i]
        image = spheres_image(seen, thick, middle, HALF, SIDE)
        for line in range(len(offsets)):
            beside = cuts[index, line, 0] * shift[0] + cuts[index, line, 1] * shift[1]
            cut_image(image, HALF, cuts[index, line], offsets[line] - beside)
        describe(descriptors, index, image)
    return descriptors, centres


def cloud_descriptors(
    points: Array, spread: float, rolls: Array, nearest: bool
) -> tuple[Singles, Array]:
    """Returns the descriptors (R, D) of a cloud at several rolls, and its image's centre (3,).

    Args:
        points: The cloud relative to its mean, along the viewing direction z, (N, 3) [size].
        spread: Half the distance of neighbouring points [size].
        rolls: Angles by which the cloud is rolled back about z, (R,) [rad].
        nearest: Whether a cell shows its nearest point.
    """
    centre = image_centre(points_image(points, spread, WIDE, SIDE, nearest), WIDE)
    x, y, depths = (points - centre).T
    descriptors = np.empty((len(rolls), 2 * (SIDE // POOLING) ** 2), dtype=np.float32)
    for index, (cosine, sine) in enumerate(zip(np.cos(rolls), np.sin(rolls), strict=True)):
        rolled = np.stack([cosine * x + sine * y, cosine * y - sine * x, depths], axis=1)
        describe(descriptors, index, points_image(rolled, spread, HALF, SIDE, nearest))
    return descriptors, centre
