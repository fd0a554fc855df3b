"""What a depth camera sees of a triangle mesh."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from typing import Any

import numpy as np
from numpy.typing import NDArray

from regkit.geometry.camera import Camera
from regkit.system.arrays import Array, Indices
from regkit.system.optional import load_library

_LARGEST = np.iinfo(np.uint16).max


@dataclass(frozen=True)
class View:
    """What there is to be measured in each pixel.

    Attributes:
        depth: (H, W) z where the pixel's ray first meets a surface [m]; 0 where it meets none.
        cosines: (H, W) cosine of the angle between the ray and the surface's normal; 1 where there
            is none.
    """

    depth: Array
    cosines: Array


@dataclass(frozen=True)
class RayCaster:
    """Casts the rays of a camera's pixels on meshes.

    Attributes:
        camera: The camera.
    """

    camera: Camera

    def view(self, vertices: Array, faces: Indices) -> View:
        """The view of a mesh.

        Open3D's own distances depend in their last bits on the processor; the planes of the
        triangles that it found do not, and so the noisy image is the same everywhere.

        Args:
            vertices: (V, 3) in the camera's frame, x right, y down, z forward [m].
            faces: (F, 3) vertex indices of the triangles.

        Raises:
            DependencyError: If Open3D cannot be loaded.
        """
        corners = vertices.astype(np.float32).astype(np.float64)
        rows, columns = self._window(corners)
        rays = self._rays[rows, columns].reshape(-1, 3)
        hits, missed = _first_hits(corners, faces, rays)
        hit = hits != missed
        a, b, c = np.moveaxis(corners[faces[hits[hit]]], 1, 0)
        normals = np.cross(b - a, c - a)
        along = (normals * rays[hit]).sum(axis=1)
        depth, cosines = np.zeros(len(rays)), np.ones(len(rays))
        depth[hit] = (normals * a).sum(axis=1) / along
        lengths = np.linalg.norm(normals, axis=1) * np.linalg.norm(rays[hit], axis=1)
        cosines[hit] = np.abs(along) / lengths
        whole = View(np.zeros(self._rays.shape[:2]), np.ones(self._rays.shape[:2]))
        whole.depth[rows, columns] = depth.reshape(whole.depth[rows, columns].shape)
        whole.cosines[rows, columns] = cosines.reshape(whole.depth[rows, columns].shape)
        return whole

    @cached_property
    def _rays(self) -> Array:
        return self.camera.rays()

    def _window(self, corners: Array) -> tuple[slice, slice]:
        """The rows and columns that hold the mesh's image: all, if some of it is behind."""
        if corners[:, 2].min() <= 0.0:
            return slice(None), slice(None)
        pixels = self.camera.projected(corners)
        first = np.maximum(np.floor(pixels.min(axis=0)), 0.0).astype(int)
        last = np.maximum(np.ceil(pixels.max(axis=0)) + 1.0, 0.0).astype(int)
        return slice(first[1], last[1]), slice(first[0], last[0])


def ray_cast(vertices: Array, faces: Indices, camera: Camera) -> Array:
    """The depth image (H, W) [m] of a mesh: z where a pixel's ray first meets it, 0 elsewhere.

    Args:
        vertices: (V, 3) in the camera's frame, x right, y down, z forward [m].
        faces: (F, 3) vertex indices of the triangles.
        camera: The camera.

    Raises:
        DependencyError: If Open3D cannot be loaded.
    """
    return RayCaster(camera).view(vertices, faces).depth


def stored(depth: Array, depth_scale: float) -> NDArray[np.uint16]:
    """A depth image (H, W) [m] in whole units, 0 where there is nothing or it is out of range.

    Args:
        depth: (H, W) measured depth [m]; 0 where nothing was measured.
        depth_scale: Stored units per metre.
    """
    units = np.rint(depth * depth_scale)
    return np.where((units >= 1) & (units <= _LARGEST), units, 0).astype(np.uint16)


def _first_hits(corners: Array, faces: Indices, rays: Array) -> tuple[NDArray[np.uint32], int]:
    """The triangle (N,) that each ray (N, 3) from the origin meets first; what stands for none."""
    library: Any = load_library("open3d")
    scene = library.t.geometry.RaycastingScene()
    scene.add_triangles(
        library.core.Tensor(corners.astype(np.float32)),
        library.core.Tensor(faces.astype(np.uint32)),
    )
    both = np.concatenate([np.zeros_like(rays), rays], axis=1).astype(np.float32)
    return scene.cast_rays(library.core.Tensor(both))["primitive_ids"].numpy(), scene.INVALID_ID
