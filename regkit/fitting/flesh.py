"""Samples of a mesh for each segment: points inside it and points on its surface."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import numpy as np
import scipy

from regkit.fitting.layout import Layout, SegmentFrame
from regkit.geometry.inside import inside
from regkit.geometry.rigid import transformed
from regkit.geometry.skinned_mesh import SkinnedMesh
from regkit.system.arrays import Array, Indices


@dataclass(frozen=True)
class Flesh:
    """One segment's part of a mesh, in the segment's frame.

    Attributes:
        interior: Points inside, on a regular grid, (N, 3) [m].
        surface: Centres of the triangles, (M, 3) [m].
        areas: Areas of the triangles, (M,) [m^2].
    """

    interior: Array
    surface: Array
    areas: Array

    def local(self, frame: SegmentFrame) -> Flesh:
        """Returns the same samples in a segment's frame, from samples in the template's axes."""
        return Flesh(frame.local(self.interior), frame.local(self.surface), self.areas)


def flesh_of(mesh: SkinnedMesh, layout: Layout, spacing: float) -> dict[str, Flesh]:
    """Returns the flesh of every segment in its frame.

    Args:
        mesh: The mesh.
        layout: Its division into segments.
        spacing: Spacing of the grid [m].
    """
    parts = divided(mesh, layout.T_template_mesh, layout.owners, list(layout.frames), spacing)
    return {name: part.local(layout.frames[name]) for name, part in parts.items()}


def divided(
    mesh: SkinnedMesh,
    T_template_mesh: Array,
    owner_of_bone: Mapping[str, str],
    names: Sequence[str],
    spacing: float,
) -> dict[str, Flesh]:
    """Returns the flesh of every segment in the template's axes, in the pose of the mesh.

    A point belongs to the segment with the largest weight at the nearest vertex.

    Args:
        mesh: The mesh.
        T_template_mesh: Transform from the mesh's axes to the template's, (4, 4) [m].
        owner_of_bone: Segment of each bone, by the bone's label.
        names: Names of the segments.
        spacing: Spacing of the grid [m].
    """
    vertices = transformed(T_template_mesh, mesh.vertices)
    followed = np.zeros((len(vertices), len(names)))
    owners = np.array([names.index(owner_of_bone[label]) for label in mesh.labels])
    np.add.at(followed, (np.arange(len(vertices))[:, None], owners[mesh.indices]), mesh.weights)
    owner_of_vertex = followed.argmax(axis=1)
    corners = vertices[mesh.faces]
    centres = corners.mean(axis=1)
    edges = corners[:, 1:] - corners[:, :1]
    areas = np.linalg.norm(np.cross(edges[:, 0], edges[:, 1]), axis=1) / 2.0
    interior = interior_points(vertices, mesh.faces, spacing)
    tree = scipy.spatial.cKDTree(vertices)
    owner_of_point = owner_of_vertex[tree.query(interior)[1]]
    owner_of_face = owner_of_vertex[tree.query(centres)[1]]
    return {
        name: Flesh(
            interior[owner_of_point == index],
            centres[owner_of_face == index],
            areas[owner_of_face == index],
        )
        for index, name in enumerate(names)
    }


def interior_points(vertices: Array, faces: Indices, spacing: float) -> Array:
    """Returns the points (N, 3) [m] of a grid, symmetric about the plane x = 0, inside a mesh.

    Args:
        vertices: Vertices of the mesh, (V, 3) [m].
        faces: Vertex indices of its triangles, (F, 3); holes are closed.
        spacing: Spacing of the grid [m].
    """
    corners, triangles = closed(vertices, faces)
    cells = np.ceil(np.abs(corners).max(axis=0) / spacing).astype(int)
    axes = [(np.arange(-count, count) + 0.5) * spacing for count in cells]
    grid = np.stack(np.meshgrid(*axes, indexing="ij"), axis=-1).reshape(-1, 3)
    near = (grid > corners.min(axis=0)) & (grid < corners.max(axis=0))
    grid = grid[near.all(axis=1)]
    return np.asarray(grid[inside(grid, corners, triangles)])


def points_in_box(vertices: Array, faces: Indices, low: Array, high: Array, count: int) -> Array:
    """Returns the points (N, 3) [m] inside a closed mesh of a grid that fills a box.

    Args:
        vertices: Vertices of the mesh, (V, 3) [m].
        faces: Vertex indices of its triangles, (F, 3).
        low: Smallest corner of the box, (3,) [m].
        high: Its largest corner, (3,) [m].
        count: Number of points of the grid, roughly.
    """
    extents = np.maximum(high - low, 1e-3 * float((high - low).max()))
    spacing = float(np.cbrt(extents.prod() / count))
    cells = np.maximum(np.ceil(extents / spacing).astype(int), 1)
    axes = [
        start + (np.arange(number) + 0.5) * extent / number
        for start, extent, number in zip(low, extents, cells, strict=True)
    ]
    grid = np.stack(np.meshgrid(*axes, indexing="ij"), axis=-1).reshape(-1, 3)
    return np.asarray(grid[inside(grid, vertices, faces)])


def closed(vertices: Array, faces: Indices) -> tuple[Array, Indices]:
    """Returns the mesh with each hole closed by a fan of triangles around the hole's centre."""
    edges = np.concatenate([faces[:, [0, 1]], faces[:, [1, 2]], faces[:, [2, 0]]])
    reverse = {(int(b), int(a)) for a, b in edges}
    rim = np.array([edge for edge in edges if (int(edge[0]), int(edge[1])) not in reverse])
    if not len(rim):
        return vertices, faces
    count = len(vertices)
    adjacency = scipy.sparse.coo_array(
        (np.ones(len(rim)), (rim[:, 0], rim[:, 1])), shape=(count, count)
    )
    _, hole = scipy.sparse.csgraph.connected_components(adjacency, directed=False)
    holes, hole_of_edge = np.unique(hole[rim[:, 0]], return_inverse=True)
    middles = [
        vertices[rim[hole_of_edge == index]].mean(axis=(0, 1)) for index in range(len(holes))
    ]
    fans = np.column_stack([rim[:, 1], rim[:, 0], count + hole_of_edge])
    return np.concatenate([vertices, middles]), np.concatenate([faces, fans])
