"""Occlusions of primitives by one another, in compiled loops."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from regkit.system.arrays import Array
from regkit.system.compiled import compiled


@compiled
def free_rays(
    targets: Array, centres: Array, axes: Array, radii: Array, hiding: NDArray[np.bool_]
) -> Array:
    """Returns the fraction (K,) of each primitive's targets that a camera at the origin sees.

    A ray is occluded by any ellipsoid that it intersects and whose centre is nearer to the camera
    than the primitive's.

    Args:
        targets: Target points of each primitive, (K, M, 3) [m].
        centres: Centres of the ellipsoids, (K, 3) [m].
        axes: Axes of the ellipsoids, (K, 3, 3).
        radii: Half axes of the ellipsoids, (K, 3) [m].
        hiding: Whether each ellipsoid occludes others, (K,).
    """
    count, samples, _ = targets.shape
    shares, squares = np.empty(count), np.zeros(count)
    for k in range(count):
        for i in range(3):
            squares[k] += centres[k, i] ** 2
    ray, eye = np.empty(3), np.empty(3)
    for k in range(count):
        shares[k] = 1.0
        for sample in range(samples):
            for other in range(count):
                if other == k or not hiding[other] or squares[other] >= squares[k]:
                    continue
                # Scaled by its radii, an ellipsoid is the unit ball, and rays remain rays.
                along, square = 0.0, 0.0
                for a in range(3):
                    ray[a], eye[a] = 0.0, 0.0
                    for i in range(3):
                        ray[a] += axes[other, i, a] * targets[k, sample, i] / radii[other, a]
                        eye[a] -= axes[other, i, a] * centres[other, i] / radii[other, a]
                    along -= ray[a] * eye[a]
                    square += ray[a] ** 2
                share = min(max(along / square, 0.0), 1.0)
                distance = 0.0
                for a in range(3):
                    distance += (eye[a] + share * ray[a]) ** 2
                if distance < 1.0:
                    shares[k] -= 1.0 / samples
                    break
    return shares
