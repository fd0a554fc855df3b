"""Depth images of bodies without a recording, for samples."""

from __future__ import annotations

import numpy as np

from regkit.body.body import Body
from regkit.geometry.camera import Camera
from regkit.skeleton import Pose
from regkit.system.arrays import Array

SPACING = 0.03
"""Distance of the spheres that show the body, as a fraction of its size."""


def depth_image(body: Body, pose: Pose, camera: Camera) -> Array:
    """Returns the depth (H, W) [m] of spheres on the body's axes; infinite beside it.

    Args:
        body: The body.
        pose: Its pose in the camera's frame, wholly before the camera.
        camera: The camera.
    """
    axes = body.capsules.axis_points(SPACING * body.size)
    centres = axes.place(body.place(pose).transforms)
    depth = np.full((camera.height, camera.width), np.inf)
    across, down = np.moveaxis(camera.rays(), -1, 0)[:2]
    for centre, radius in zip(centres, axes.radii, strict=True):
        x, y, z = centre
        inside = (radius / z) ** 2 - (across - x / z) ** 2 - (down - y / z) ** 2
        front = z - z * np.sqrt(np.maximum(inside, 0.0))
        depth = np.where(inside > 0.0, np.minimum(depth, front), depth)
    return depth
