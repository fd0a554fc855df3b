"""A connected piece of the scene, with what tells a body from furniture."""

from __future__ import annotations

from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np
import scipy
from numpy.typing import NDArray

from regkit.observation import Frame
from regkit.system.arrays import Array, Indices

SAMPLE = 800
"""This many points show the extent and the shape of a piece as well as all of them."""

ROUND, SMALL = 0.1, 0.04
"""Radii of neighbourhoods, in sizes of the body: in the large ones a limb is curved, and what is
not flat in the small ones is noise."""

CENTRES = 100
"""Number of such neighbourhoods."""

FEWEST = 6
"""Smallest number of points in such a neighbourhood, or at the border of an image."""

BORDER = 3
"""Width of an image's border [px]."""


@dataclass(frozen=True)
class Piece:
    """Some of a frame's points.

    Attributes:
        frame: The frame.
        at: Indices of the points, (M,), ascending.
        gap: Distance of pieces [m].
    """

    frame: Frame
    at: Indices
    gap: float

    def with_piece(self, other: Piece) -> Piece:
        """Returns this and another piece of the frame as one."""
        return replace(self, at=np.sort(np.concatenate([self.at, other.at])))

    @cached_property
    def mask(self) -> NDArray[np.bool_]:
        """The pixels of the piece in an image, (H, W)."""
        assert self.frame.depth is not None
        pixels = self.frame.pixels
        assert pixels is not None
        found = np.zeros(self.frame.depth.shape, dtype=bool)
        found.flat[pixels[self.at]] = True
        return found

    @cached_property
    def sample(self) -> Array:
        """Some of the points, evenly spread over the surface, (K, 3) [m]."""
        points = self.frame.points[self.at]
        # The nearer a surface the denser its pixels: each counts with the area that it shows.
        areas = points[:, 2] ** 2 if self.frame.camera is not None else np.ones(len(points))
        order = np.cumsum(areas)
        steps = (np.arange(min(SAMPLE, len(points))) + 0.5) / min(SAMPLE, len(points))
        return np.asarray(points[np.unique(np.searchsorted(order, steps * order[-1]))])

    @cached_property
    def area(self) -> float:
        """Area that the piece shows to the camera [m^2]; of a cloud, of its cubes' sides."""
        points, camera = self.frame.points[self.at], self.frame.camera
        if camera is None or self.frame.pixels is None:
            return len(np.unique(np.floor(points / self.gap), axis=0)) * self.gap**2
        return float((points[:, 2] ** 2).sum() / (camera.fx * camera.fy))

    @cached_property
    def length(self) -> float:
        """Extent along the longest axis [m]."""
        centred = self.sample - self.sample.mean(axis=0)
        axis = np.linalg.svd(centred, full_matrices=False)[2][0]
        return float(np.ptp(np.percentile(centred @ axis, [1.0, 99.0])))

    @cached_property
    def depth(self) -> float:
        """Median depth [m]."""
        return float(np.median(self.frame.points[self.at, 2]))

    @cached_property
    def cut(self) -> bool:
        """Whether the piece may continue beyond the border of the image.

        The border of a cloud without a camera is unknown.
        """
        camera = self.frame.camera
        if camera is None:
            return True
        columns, rows = camera.projected(self.frame.points[self.at]).T
        edge = (rows < BORDER) | (rows >= camera.height - BORDER)
        edge |= (columns < BORDER) | (columns >= camera.width - BORDER)
        return bool(edge.sum() >= FEWEST)


def roundness(points: Array, size: float) -> float:
    """Returns how round a surface is: 0 for flat faces, about 0.1 for a person.

    It is the deviation of points from a plane in neighbourhoods as large as a limb, relative to
    their radius, less that in small neighbourhoods.

    Args:
        points: Points of the surface, evenly spread, (N, 3) [m].
        size: Size of the body [m].
    """
    tree, centres = scipy.spatial.KDTree(points), points[:: max(1, len(points) // CENTRES)]

    def thinness(radius: float) -> float:
        """Returns the median variance [m^2] of neighbourhoods along their thinnest directions."""
        found = np.asarray(tree.query_ball_point(centres, radius), dtype=object)
        around = [points[at] for at in found if len(at) >= FEWEST]
        least = [np.linalg.eigvalsh(np.cov(some.T))[0] for some in around]
        return float(np.median(least)) if least else 0.0

    large, small = thinness(ROUND * size), thinness(SMALL * size)
    return float(np.sqrt(max(large - small, 0.0))) / (ROUND * size)
