"""Points of a surface as small shaded discs."""

from __future__ import annotations

import numpy as np

from regkit.system.arrays import Array, Indices
from regkit.viewer.animation.canvas import Canvas
from regkit.viewer.animation.ellipsoids import shaded
from regkit.viewer.animation.view import View

FEWEST, MOST = 2, 9
"""Radius of a disc in a finer picture [px]."""


def add_splats(
    canvas: Canvas, view: View, points: Array, normals: Array | None, colours: Array, radius: float
) -> None:
    """Draws discs.

    Args:
        canvas: The canvas.
        view: From where they are seen.
        points: Their centres, (N, 3) [m], in the camera's axes.
        normals: Unit normals of the surface, (N, 3); None if unknown.
        colours: Their colours, (N, 3).
        radius: Their radius [m].
    """
    seen = view.moved(points)
    before = seen[:, 2] > 0.0
    if normals is not None:
        turned = normals @ view.T_view_camera[:3, :3].T
        before &= (turned * seen).sum(axis=1) < 0.0
        colours = shaded(turned, colours)
    seen, colours = seen[before], colours[before]
    # Of several discs on one pixel the nearest is drawn last.
    order = np.argsort(-seen[:, 2], kind="stable")
    seen, colours = seen[order], colours[order]
    at = np.rint(view.pixels(seen)).astype(int)
    wide = np.clip(view.focal * radius / np.median(seen[:, 2]), FEWEST, MOST) if len(seen) else 0
    reach = int(wide)
    for down in range(-reach, reach + 1):
        for right in range(-reach, reach + 1):
            if down * down + right * right > wide * wide:
                continue
            pixels = at + np.array([right, down])
            there = canvas.inside(pixels)
            canvas.add(*_nearest(pixels[there], seen[there, 2], colours[there]))


def _nearest(pixels: Indices, depths: Array, colours: Array) -> tuple[Indices, Array, Array]:
    """Returns each pixel once, with its last depth and colour."""
    keys = pixels[::-1, 0] + (pixels[:, 0].max(initial=0) + 1) * pixels[::-1, 1]
    _, last = np.unique(keys, return_index=True)
    last = len(pixels) - 1 - last
    return pixels[last], depths[last], colours[last]
