"""Ellipsoids, ray-cast and shaded."""

from __future__ import annotations

import numpy as np

from _animation.view import FINER, HEIGHT, WIDTH, View
from regkit.system.arrays import Array

_LIGHT = np.array([-0.35, -0.75, -0.56])
"""Where the light comes from, in a view's axes: from the left, above and before."""


def shaded(view: View, centre: Array, shape: Array, colour: Array) -> tuple[Array, Array, Array]:
    """An ellipsoid's pixels (N, 2), their depths (N,) [m] and colours (N, 3).

    Args:
        view: From where it is seen.
        centre: Its centre (3,) in the view's axes [m].
        shape: The matrix (3, 3) of x^T A x = 1 on its surface.
        colour: Its colour (3,).
    """
    extent = np.sqrt(np.linalg.inv(shape).diagonal()[:2]) * 1.25
    corners = centre + np.array([[sx, sy, 0.0] for sx in (-1, 1) for sy in (-1, 1)]) * np.array(
        [*extent, 0.0]
    )
    box = view.pixels(corners)
    low, high = np.floor(box.min(axis=0)).astype(int), np.ceil(box.max(axis=0)).astype(int)
    columns, rows = np.meshgrid(np.arange(low[0], high[0]), np.arange(low[1], high[1]))
    pixels = np.stack([columns.ravel(), rows.ravel()], axis=1)
    middle = view.pixels(np.array([[0.0, 0.0, 1.0]]))[0]
    rays = np.column_stack([(pixels - middle) / (FINER * view.focal), np.ones(len(pixels))])
    # The nearer root of |t ray - centre| = 1 in the metric of the ellipsoid.
    a = np.einsum("ni,ij,nj->n", rays, shape, rays)
    b = rays @ shape @ centre
    c = centre @ shape @ centre - 1.0
    hit = b * b > a * c
    hit &= ((pixels >= 0) & (pixels < [FINER * WIDTH, FINER * HEIGHT])).all(axis=1)
    depth = (b[hit] - np.sqrt(b[hit] ** 2 - a[hit] * c)) / a[hit]
    normals = (depth[:, None] * rays[hit] - centre) @ shape
    normals /= np.linalg.norm(normals, axis=1, keepdims=True)
    light = np.clip(normals @ (_LIGHT / np.linalg.norm(_LIGHT)), 0.0, 1.0)
    rim = np.clip(1.0 + normals[:, 2], 0.0, 1.0) ** 2
    brightness = 0.72 + 0.36 * light - 0.30 * rim
    shades = np.clip(brightness[:, None] * colour + 26.0 * light[:, None] ** 6, 0.0, 255.0)
    return pixels[hit], depth, shades
