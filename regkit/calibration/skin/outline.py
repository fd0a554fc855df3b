"""The outline of a body in a depth image, and its distances to a skin.

An outline has no noise of depth: it is known to about a pixel, and shows breadths and heights that
the depths of few pixels hardly show.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import numpy as np
import scipy

from regkit.calibration.skin.skin_distances import SkinDistances
from regkit.calibration.skin.skin_points import SkinPoints
from regkit.geometry.camera import Camera
from regkit.system.arrays import Array

SMOOTHED = 2.0
"""Standard deviation of the filter of the mask whose slope is the direction of the outline [px]."""

SIDES = ((0, 1), (0, -1), (1, 1), (1, -1))
"""Axis and step to each of the four neighbours of a pixel."""

NEIGHBOURS = 16
"""Number of points of the skin's rim near a pixel, among which one of the same direction is met."""

RIM = 0.2
"""The rim of a skin is where ray and normal have a cosine smaller than this."""

AGREE = 0.6
"""Least cosine of the angle between the directions of an outline and of the rim that it meets."""

FAR = 0.06
"""An outline that is farther than this from the rim does not meet it, as a fraction of the size."""


@dataclass(frozen=True)
class Outline:
    """O points of the outline of a body, between pixels that show it and pixels of free space.

    Attributes:
        camera: The camera.
        pixels: Their pixels, column and row, (O, 2).
        directions: Unit directions in the picture, away from the body, (O, 2).
    """

    camera: Camera
    pixels: Array
    directions: Array

    @classmethod
    def of(cls, camera: Camera, depth: Array, most: int) -> Outline:
        """Returns the outline in a depth image.

        Args:
            camera: Its camera.
            depth: The depth image, (H, W) [m]; zero marks free space, NaN an unknown pixel. The
                picture's border and unknown pixels do not show where the body ends.
            most: Number of points, spread evenly, if there are more.
        """
        seen = depth > 0.0
        # A missing pixel inside the body is no outline.
        filled = scipy.ndimage.binary_closing(seen) | seen
        free = ~(filled | np.isnan(depth))
        beside = np.zeros_like(seen)
        for axis, step in SIDES:
            beside |= np.roll(free, step, axis)
        edge = seen & beside
        edge[[0, -1]] = edge[:, [0, -1]] = False
        rows, columns = np.nonzero(edge)
        slopes = np.gradient(scipy.ndimage.gaussian_filter(filled.astype(float), SMOOTHED))
        outwards = -np.column_stack([slopes[1][edge], slopes[0][edge]])
        outwards /= np.maximum(np.linalg.norm(outwards, axis=1, keepdims=True), 1e-9)
        # The body ends between the last pixel that shows it and the next.
        pixels = np.column_stack([columns, rows]) + 0.5 * outwards
        kept = np.sort(np.random.default_rng(0).permutation(len(pixels))[:most])
        return cls(camera, pixels[kept], outwards[kept])

    @cached_property
    def rays(self) -> Array:
        """Directions of the rays through the points, scaled to z = 1, (O, 3)."""
        camera = self.camera
        x = (self.pixels[:, 0] - camera.cx) / camera.fx
        y = (self.pixels[:, 1] - camera.cy) / camera.fy
        return np.column_stack([x, y, np.ones_like(x)])

    def distances(
        self, skin: SkinPoints, placed: Array, normals: Array, size: float
    ) -> SkinDistances:
        """Returns the distances of the rim of the skin to the outline, across the rays.

        Args:
            skin: Points on the skin.
            placed: Their places in the camera's frame, (Q, 3) [m].
            normals: Their unit normals, (Q, 3).
            size: The body's size [m].
        """
        rays = placed / np.linalg.norm(placed, axis=1, keepdims=True)
        slants = np.einsum("qi,qi->q", rays, normals)
        rim = np.flatnonzero((np.abs(slants) < RIM) & (placed[:, 2] > 0.0))
        if not len(rim) or not len(self.pixels):
            return SkinDistances.none(lost=len(self.pixels))
        across = normals[rim] - slants[rim, None] * rays[rim]
        across /= np.linalg.norm(across, axis=1, keepdims=True)
        flat = across[:, :2] / np.maximum(np.linalg.norm(across[:, :2], axis=1), 1e-9)[:, None]
        found = scipy.spatial.cKDTree(self.camera.projected(placed[rim])).query(
            self.pixels, k=np.arange(1, min(NEIGHBOURS, len(rim)) + 1)
        )
        gaps, near = np.asarray(found[0]), np.asarray(found[1])
        metres = gaps * placed[rim[near], 2] / self.camera.fx
        alike = np.einsum("oi,oki->ok", self.directions, flat[near]) > AGREE
        costs = np.where(alike & (metres < FAR * size), metres, np.inf)
        met = np.flatnonzero(np.isfinite(costs.min(axis=1)))
        chosen = near[met, costs[met].argmin(axis=1)]
        points = rim[chosen]
        seen = self.rays[met] * placed[points, 2:]
        return SkinDistances(
            lengths=((seen - placed[points]) * across[chosen]).sum(axis=1),
            directions=across[chosen],
            corners=skin.corners[points],
            shares=skin.shares[points],
            lost=len(self.pixels) - len(met),
        )
