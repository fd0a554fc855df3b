"""The meshes of templates: decimated, with segments as bones."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import scipy

from regkit.body import BodyDescription
from regkit.fitting.clusters import spread
from regkit.fitting.layout import Layout
from regkit.geometry.rigid import rigid, transformed
from regkit.geometry.skinned_mesh import SkinnedMesh
from regkit.geometry.surface import vertex_normals
from regkit.system.arrays import Indices


def on_segments(mesh: SkinnedMesh, layout: Layout, template: BodyDescription) -> SkinnedMesh:
    """Returns the mesh in the template's axes, with the template's segments as bones.

    A vertex's weight for a segment is the sum of its weights for the segment's bones.

    Args:
        mesh: The mesh.
        layout: Its division into segments.
        template: The template.
    """
    names = tuple(template.segments)
    owners = np.array([names.index(layout.owners[label]) for label in mesh.labels])
    weights = np.zeros((len(mesh.vertices), len(names)))
    np.add.at(weights, (np.arange(len(weights))[:, None], owners[mesh.indices]), mesh.weights)
    carriers = int((weights > 0.0).sum(axis=1).max())
    indices = np.argsort(-weights, axis=1, kind="stable")[:, :carriers]
    weights = np.take_along_axis(weights, indices, axis=1)
    frames = [layout.frames[name] for name in names]
    return SkinnedMesh(
        vertices=transformed(layout.T_template_mesh, mesh.vertices),
        faces=mesh.faces,
        labels=names,
        parents=np.array([_parent(template, name) for name in names]),
        rest=rigid(
            np.array([frame.rotation.T for frame in frames]),
            np.array([frame.origin for frame in frames]),
        ),
        indices=indices,
        weights=weights / weights.sum(axis=1, keepdims=True),
    )


def decimated(mesh: SkinnedMesh, count: int) -> SkinnedMesh:
    """Returns the largest connected piece of a mesh, reduced; see ``decimation``."""
    return decimation(mesh, count)[0]


def decimation(mesh: SkinnedMesh, count: int) -> tuple[SkinnedMesh, Indices]:
    """Returns the largest connected piece of a mesh, reduced to ``count`` of its vertices (count,).

    The kept vertices are spread evenly over the surface, and every other vertex joins the nearest
    of them. The distance includes the normals, so that the two sides of a finger stay separate.
    Triangles between three kept vertices remain. Separate pieces such as eyes are left out.

    Source: Valette, Chassery, Approximated centroidal Voronoi diagrams for uniform polygonal mesh
    coarsening, Computer Graphics Forum 23, 2004; here farthest-point samples define the clusters.
    """
    mesh, piece = _largest_piece(mesh)
    if count >= len(mesh.vertices):
        return mesh, piece
    features = np.concatenate(
        [mesh.vertices, _spacing(mesh, count) * vertex_normals(mesh.vertices, mesh.faces)], axis=1
    )
    kept = spread(features, count)
    cluster = np.asarray(scipy.spatial.cKDTree(features[kept]).query(features)[1])
    corners = cluster[mesh.faces]
    ordered = np.sort(corners, axis=1)
    triangles = corners[(ordered[:, 0] < ordered[:, 1]) & (ordered[:, 1] < ordered[:, 2])]
    _, first = np.unique(np.sort(triangles, axis=1), axis=0, return_index=True)
    return _subset(replace(mesh, faces=kept[triangles[np.sort(first)]]), kept), piece[kept]


def _largest_piece(mesh: SkinnedMesh) -> tuple[SkinnedMesh, Indices]:
    """Returns the largest connected piece of a mesh, and the indices of its vertices."""
    count = len(mesh.vertices)
    ends = np.concatenate([mesh.faces[:, :2], mesh.faces[:, 1:]])
    adjacency = scipy.sparse.coo_array(
        (np.ones(len(ends)), (ends[:, 0], ends[:, 1])), shape=(count, count)
    )
    _, piece = scipy.sparse.csgraph.connected_components(adjacency, directed=False)
    largest = np.bincount(piece).argmax()
    own = replace(mesh, faces=mesh.faces[piece[mesh.faces[:, 0]] == largest])
    members = np.flatnonzero(piece == largest)
    return _subset(own, members), members


def _subset(mesh: SkinnedMesh, kept: Indices) -> SkinnedMesh:
    """Returns a mesh with some of its vertices, on which all its faces must lie."""
    new_index = np.zeros(len(mesh.vertices), dtype=np.intp)
    new_index[kept] = np.arange(len(kept))
    return replace(
        mesh,
        vertices=mesh.vertices[kept],
        faces=new_index[mesh.faces],
        indices=mesh.indices[kept],
        weights=mesh.weights[kept],
    )


def _spacing(mesh: SkinnedMesh, count: int) -> float:
    """Returns the approximate spacing of ``count`` vertices on the surface [m]."""
    corners = mesh.vertices[mesh.faces]
    edges = corners[:, 1:] - corners[:, :1]
    area = 0.5 * float(np.linalg.norm(np.cross(edges[:, 0], edges[:, 1]), axis=1).sum())
    return float(np.sqrt(area / count))


def _parent(template: BodyDescription, name: str) -> int:
    parent = template.segments[name].parent
    return -1 if parent is None else list(template.segments).index(parent)
