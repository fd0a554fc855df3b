"""What a depth camera measures of a triangle mesh."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from regkit.arrays import Array, Indices
from regkit.camera import Camera
from regkit.optional import open3d

_LARGEST = np.iinfo(np.uint16).max


def ray_cast(vertices: Array, faces: Indices, camera: Camera) -> Array:
    """The depth image (H, W) [m] of a mesh: z where a pixel's ray first meets it, 0 elsewhere.

    Args:
        vertices: (V, 3) in the camera's frame, x right, y down, z forward [m].
        faces: (F, 3) vertex indices of the triangles.
        camera: The camera.

    Raises:
        DependencyError: If Open3D cannot be loaded.
    """
    library = open3d()
    corners = vertices.astype(np.float32)
    rays = camera.rays().reshape(-1, 3)
    scene = library.t.geometry.RaycastingScene()
    scene.add_triangles(library.core.Tensor(corners), library.core.Tensor(faces.astype(np.uint32)))
    both = np.concatenate([np.zeros_like(rays), rays], axis=1).astype(np.float32)
    hits = scene.cast_rays(library.core.Tensor(both))["primitive_ids"].numpy()
    hit = hits != scene.INVALID_ID
    # Open3D's own distances depend in their last bits on the processor; the planes of the triangles
    # that it found do not, and so the noisy image is the same everywhere.
    a, b, c = np.moveaxis(corners[faces[hits[hit]]].astype(np.float64), 1, 0)
    normals = np.cross(b - a, c - a)
    depth = np.zeros(len(rays))
    depth[hit] = (normals * a).sum(axis=1) / (normals * rays[hit]).sum(axis=1)
    return depth.reshape(camera.height, camera.width)


def measured(
    depth: Array, sigma: float, depth_scale: float, random: np.random.Generator
) -> NDArray[np.uint16]:
    """What a sensor with noise along its axis stores of a depth image.

    Args:
        depth: (H, W) true depth [m]; 0 where there is nothing.
        sigma: Standard deviation of the noise [m].
        depth_scale: Stored units per metre.
        random: Where the noise comes from.

    Returns:
        (H, W) whole units; 0 where there is nothing.
    """
    noisy = (depth + sigma * random.standard_normal(depth.shape)) * depth_scale
    units = np.clip(np.rint(noisy), 1, _LARGEST).astype(np.uint16)
    return np.where(depth > 0.0, units, np.uint16(0))
