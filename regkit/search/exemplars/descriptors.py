"""Descriptors of exemplars and clouds: what their small depth images show, centred."""

from __future__ import annotations

from math import cos, sin

import numpy as np

from regkit.search.exemplars.images import (
    cut_image,
    described,
    image_centre,
    offset_of_share,
    points_image,
    spheres_image,
)
from regkit.system.arrays import Array, Singles
from regkit.system.compiled import compiled

SIDE, POOLING = 48, 2
"""Number of cells of an image, and of those in a pooled cell, along each side."""

HALF, WIDE = 0.68, 0.782
"""Half the width of an image, and of the wider one that finds its centre [size]."""

DEEPEST = 0.22
"""Depth from the centre beyond which differences count no more [size]."""


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
    count = len(places)
    descriptors = np.empty((count, 2 * (SIDE // POOLING) ** 2), dtype=np.float32)
    centres = np.empty((count, 3))
    for index in range(count):
        there = np.flatnonzero(far <= reaches[index])
        seen, thick = np.empty((len(there), 3)), radii[there]
        middle = np.zeros(3)
        for row, sphere in enumerate(there):
            for i in range(3):
                seen[row, i] = (
                    views[index, i, 0] * places[index, sphere, 0]
                    + views[index, i, 1] * places[index, sphere, 1]
                    + views[index, i, 2] * places[index, sphere, 2]
                )
            middle += seen[row] / len(there)
        image = spheres_image(seen - middle, thick, WIDE, SIDE)
        offsets = np.full(cuts.shape[1], np.inf)
        for line in range(len(offsets)):
            direction, share = cuts[index, line, :2], cuts[index, line, 2]
            if share < 1.0:
                offsets[line] = offset_of_share(image, WIDE, direction, share)
                cut_image(image, WIDE, direction, offsets[line])
        shift = image_centre(image, WIDE)
        centre = middle + shift
        image = spheres_image(seen - centre, thick, HALF, SIDE)
        for line in range(len(offsets)):
            direction = cuts[index, line, :2]
            if np.isfinite(offsets[line]):
                beside = direction[0] * shift[0] + direction[1] * shift[1]
                cut_image(image, HALF, direction, offsets[line] - beside)
        descriptors[index] = described(image, POOLING, DEEPEST)
        centres[index] = centre
    return descriptors, centres


@compiled
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
    around = points - centre
    descriptors = np.empty((len(rolls), 2 * (SIDE // POOLING) ** 2), dtype=np.float32)
    rolled = around.copy()
    for index in range(len(rolls)):
        cosine, sine = cos(rolls[index]), sin(rolls[index])
        for point in range(len(around)):
            rolled[point, 0] = cosine * around[point, 0] + sine * around[point, 1]
            rolled[point, 1] = cosine * around[point, 1] - sine * around[point, 0]
        image = points_image(rolled, spread, HALF, SIDE, nearest)
        descriptors[index] = described(image, POOLING, DEEPEST)
    return descriptors, centre
