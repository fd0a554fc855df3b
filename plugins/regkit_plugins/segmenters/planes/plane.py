"""Planes with the noise of their points."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from regkit.system.arrays import Array

NOISE = 0.003
"""Deviation of points that is allowed in the search, at a depth of 1 m [m]. That of a depth camera
grows with the square of the depth; this is the step of a first Kinect's depths."""

DEVIATIONS = 3.0
"""Number of standard deviations of the plane's points that are removed with it."""

BELOW = 3.0
"""Reflections and noise behind a plane are removed this many times as far as in front of it."""


@dataclass(frozen=True)
class Plane:
    """The points x with ``normal . x + offset = 0``; the camera is on its positive side.

    Attributes:
        normal: Unit normal in the camera frame, (3,).
        offset: Distance of the camera [m].
        margin: Least half thickness [m].
        noise: Standard deviation of its points at a depth of 1 m [m].
    """

    normal: Array
    offset: float
    margin: float
    noise: float

    def heights(self, points: Array) -> Array:
        """Returns the signed distances (N,) [m] of points (N, 3), positive on the camera's side."""
        return np.asarray(points @ self.normal + self.offset)

    def thickness(self, points: Array) -> Array:
        """Returns the half thickness (N,) [m] of the plane where points (N, 3) are."""
        return np.asarray(np.maximum(self.margin, DEVIATIONS * self.noise * points[:, 2] ** 2))

    def holds(self, points: Array, part: float = 1.0) -> NDArray[np.bool_]:
        """Returns a mask (N,) of the points in the plane, or a little behind it.

        Args:
            points: Points, (N, 3) [m].
            part: Part of the plane's thickness that counts, on the camera's side.
        """
        heights, half = self.heights(points), self.thickness(points)
        return np.asarray((heights < part * half) & (heights > -BELOW * half))
