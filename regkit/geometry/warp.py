"""A smooth displacement of space that follows the displacements of given points."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from regkit.system.arrays import Array

STIFFNESS = 1e-3
"""Weight of the undeformed local map, relative to that of the points: it decides what the points
leave open, such as what lies off a plane of points."""


@dataclass(frozen=True)
class Warp:
    """Affine moving least squares: near each point, the affine map that fits its surroundings best.

    Source: Schaefer, McPhail, Warren, Image deformation using moving least squares, SIGGRAPH 2006,
    eq. 1, with the weights 1 / (d^2 + extent^2)^2.

    Attributes:
        points: The given points, (N, 3) [m].
        displacements: Their displacements, (N, 3) [m].
        weights: Their own weights, (N,).
        extent: Distance within which points count alike [m].
    """

    points: Array
    displacements: Array
    weights: Array
    extent: float

    def at(self, point: Array) -> tuple[Array, Array]:
        """Returns the image (3,) [m] of a point (3,), and the linear map (3, 3) around it."""
        if not len(self.points):
            return point, np.eye(3)
        offsets = self.points - point
        squares = (offsets**2).sum(axis=1)
        weights = self.weights / (squares + self.extent**2) ** 2
        weights = weights / weights.sum()
        middle, shift = weights @ offsets, weights @ self.displacements
        centred = (offsets - middle) * weights[:, None]
        spread = centred.T @ offsets
        spread += (STIFFNESS * np.trace(spread) + 1e-12) * np.eye(3)
        gradient = np.linalg.solve(spread, centred.T @ self.displacements).T
        return point + shift - gradient @ middle, np.eye(3) + gradient
