"""Ellipsoids, ray-cast and shaded."""

from __future__ import annotations

import numpy as np

from regkit.system.arrays import Array
from regkit.viewer.animation.canvas import Canvas
from regkit.viewer.animation.view import View

LIGHT = np.array([-0.35, -0.75, -0.56]) / np.linalg.norm([-0.35, -0.75, -0.56])
"""Direction to the light in a view's axes: from the left, above and before."""


def add_ellipsoids(
    canvas: Canvas, view: View, centres: Array, axes: Array, radii: Array, colours: Array
) -> None:
    """Draws ellipsoids.

    Args:
        canvas: The canvas.
        view: From where they are seen.
        centres: Their centres, (K, 3) [m], in the camera's axes.
        axes: R_camera_ellipsoid, (K, 3, 3).
        radii: Radii along their axes, (K, 3) [m].
        colours: Their colours, (K, 3).
    """
    turned = view.T_view_camera[:3, :3] @ axes
    shapes = (turned / radii[:, None, :] ** 2) @ np.swapaxes(turned, 1, 2)
    for centre, shape, colour in zip(view.moved(centres), shapes, colours, strict=True):
        _add(canvas, view, centre, shape, colour)


def shaded(normals: Array, colours: Array) -> Array:
    """Returns colours (N, 3) lit by their unit normals (N, 3) in a view's axes."""
    light = np.clip(normals @ LIGHT, 0.0, 1.0)
    rim = np.clip(1.0 + normals[:, 2], 0.0, 1.0) ** 2
    brightness = 0.72 + 0.36 * light - 0.30 * rim
    lit = brightness[:, None] * colours + 26.0 * light[:, None] ** 6
    return np.asarray(np.clip(lit, 0.0, 255.0))


def _add(canvas: Canvas, view: View, centre: Array, shape: Array, colour: Array) -> None:
    """Draws an ellipsoid x^T A x = 1 about a centre (3,) [m], both in the view's axes."""
    extent = 1.25 * np.sqrt(np.linalg.inv(shape).diagonal())
    if centre[2] <= 2.0 * extent.max():
        return
    signs = np.array([[x, y, 0.0] for x in (-1, 1) for y in (-1, 1)])
    box = view.pixels(centre + signs * extent)
    size = canvas.depths.shape[::-1]
    low = np.clip(np.floor(box.min(axis=0)), 0, size).astype(int)
    high = np.clip(np.ceil(box.max(axis=0)), 0, size).astype(int)
    columns, rows = np.meshgrid(np.arange(low[0], high[0]), np.arange(low[1], high[1]))
    pixels = np.stack([columns.ravel(), rows.ravel()], axis=1)
    rays = np.column_stack([(pixels - view.centre) / view.focal, np.ones(len(pixels))])
    # The nearer root of |t ray - centre| = 1 in the metric of the ellipsoid.
    a = np.einsum("ni,ij,nj->n", rays, shape, rays)
    b = rays @ shape @ centre
    c = centre @ shape @ centre - 1.0
    hit = b * b > a * c
    depth = (b[hit] - np.sqrt(b[hit] ** 2 - a[hit] * c)) / a[hit]
    normals = (depth[:, None] * rays[hit] - centre) @ shape
    normals /= np.linalg.norm(normals, axis=1, keepdims=True)
    canvas.add(pixels[hit], depth, shaded(normals, colour))
