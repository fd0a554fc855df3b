"""Borders of a picture at which the data end: there a body may go on out of sight."""

from __future__ import annotations

import numpy as np

from regkit.geometry.camera import Camera
from regkit.observation.unknown_cuts import unknown_cuts
from regkit.system.arrays import Array

STRIP = 2
"""Width of the strip along a border in which data touch it [px]."""

TOUCHING = 0.04
"""Least length over which data touch a border, as a fraction of their longer side."""


def cutting_borders(camera: Camera, depth: Array, points: Array) -> Array:
    """Returns the borders at which a picture cuts the data off, the longest contact first.

    The edges of unknown regions are borders too.

    Args:
        camera: The camera.
        depth: Its depth image, (H, W) [m]; NaN where it is unknown.
        points: The data, (N, 3) [m].

    Returns:
        Outward unit normals of the planes through the camera and the borders, (B, 3).
    """
    pixels = camera.projected(points)
    least = max(3.0, TOUCHING * float(np.ptp(pixels, axis=0).max()))
    right = (camera.width - 0.5 - camera.cx) / camera.fx
    left = (camera.cx + 0.5) / camera.fx
    below = (camera.height - 0.5 - camera.cy) / camera.fy
    above = (camera.cy + 0.5) / camera.fy
    shown = depth > 0.0
    sides = [
        (shown[:, -STRIP:].any(axis=1), [1.0, 0.0, -right]),
        (shown[:, :STRIP].any(axis=1), [-1.0, 0.0, -left]),
        (shown[-STRIP:].any(axis=0), [0.0, 1.0, -below]),
        (shown[:STRIP].any(axis=0), [0.0, -1.0, -above]),
    ]
    found = [
        (int(strip.sum()), np.array(normal)) for strip, normal in sides if strip.sum() >= least
    ]
    found += unknown_cuts(camera, depth, points)
    found.sort(key=lambda one: -one[0])
    normals = np.array([normal for _, normal in found]).reshape(-1, 3)
    return np.asarray(normals / np.linalg.norm(normals, axis=1, keepdims=True))
