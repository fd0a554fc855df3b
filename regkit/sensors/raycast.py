"""Ray casting of triangle meshes: depth and incidence angles of each pixel."""

from __future__ import annotations

from collections.abc import Sequence
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
    """The exact depth and incidence of each pixel.

    Attributes:
        depth: z of the first intersection of the pixel's ray, (H, W) [m]; 0 if there is none.
        cosines: Cosine of the angle between ray and surface normal, (H, W); 1 if there is none.
    """

    depth: Array
    cosines: Array

    @classmethod
    def of_nothing(cls, shape: tuple[int, int]) -> View:
        """Returns the view (H, W) in which no ray meets anything."""
        return cls(np.zeros(shape), np.ones(shape))


def nearest(views: Sequence[View]) -> tuple[View, NDArray[np.intp]]:
    """Returns the view of several opaque surfaces, and which of them each pixel shows.

    Each surface is cast alone, so that what it shows does not depend on the others, to the last
    bit; of those at the same depth the first is seen.

    Args:
        views: The view (H, W) of each surface.

    Returns:
        The common view, and the index (H, W) of the surface; -1 for none.
    """
    depths = np.array([view.depth for view in views])
    index = np.where(depths > 0.0, depths, np.inf).argmin(axis=0)[None]
    cosines = np.array([view.cosines for view in views])
    depth = np.take_along_axis(depths, index, axis=0)[0]
    common = View(depth, np.take_along_axis(cosines, index, axis=0)[0])
    return common, np.where(depth > 0.0, index[0], -1)


@dataclass(frozen=True)
class RayCaster:
    """Casts the rays of a camera's pixels at meshes.

    Attributes:
        camera: The camera.
    """

    camera: Camera

    def view(self, vertices: Array, faces: Indices) -> View:
        """Returns the view of a mesh.

        The last bits of Open3D's distances depend on the processor. Depths are computed from the
        planes of the intersected triangles instead, so that images are reproducible.

        Args:
            vertices: Vertices in the camera frame (x right, y down, z forward), (V, 3) [m].
            faces: Vertex indices of the triangles, (F, 3).

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
        whole = View.of_nothing((self.camera.height, self.camera.width))
        whole.depth[rows, columns] = depth.reshape(whole.depth[rows, columns].shape)
        whole.cosines[rows, columns] = cosines.reshape(whole.depth[rows, columns].shape)
        return whole

    @cached_property
    def _rays(self) -> Array:
        return self.camera.rays()

    def _window(self, corners: Array) -> tuple[slice, slice]:
        """Returns the rows and columns of the mesh's image; all if part of it is behind."""
        if corners[:, 2].min() <= 0.0:
            return slice(None), slice(None)
        pixels = self.camera.projected(corners)
        first = np.maximum(np.floor(pixels.min(axis=0)), 0.0).astype(int)
        last = np.maximum(np.ceil(pixels.max(axis=0)) + 1.0, 0.0).astype(int)
        return slice(first[1], last[1]), slice(first[0], last[0])


def ray_cast(vertices: Array, faces: Indices, camera: Camera) -> Array:
    """Returns the depth image (H, W) [m] of a mesh; 0 where a pixel's ray misses it.

    Args:
        vertices: Vertices in the camera frame (x right, y down, z forward), (V, 3) [m].
        faces: Vertex indices of the triangles, (F, 3).
        camera: The camera.

    Raises:
        DependencyError: If Open3D cannot be loaded.
    """
    return RayCaster(camera).view(vertices, faces).depth


def stored(depth: Array, depth_scale: float) -> NDArray[np.uint16]:
    """Returns a depth image (H, W) in integer units; 0 for invalid or out-of-range pixels.

    Args:
        depth: Measured depth, (H, W) [m]; 0 for invalid pixels.
        depth_scale: Stored units per metre.
    """
    units = np.rint(depth * depth_scale)
    return np.where((units >= 1) & (units <= _LARGEST), units, 0).astype(np.uint16)


def _first_hits(corners: Array, faces: Indices, rays: Array) -> tuple[NDArray[np.uint32], int]:
    """Returns the first triangle (N,) on each ray (N, 3) from the origin, and the code of none."""
    library: Any = load_library("open3d")
    scene = library.t.geometry.RaycastingScene()
    scene.add_triangles(
        library.core.Tensor(corners.astype(np.float32)),
        library.core.Tensor(faces.astype(np.uint32)),
    )
    both = np.concatenate([np.zeros_like(rays), rays], axis=1).astype(np.float32)
    return scene.cast_rays(library.core.Tensor(both))["primitive_ids"].numpy(), scene.INVALID_ID
