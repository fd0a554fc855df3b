"""A stump of the forearm that continues the mesh of a hand, or a skin that closes its wrist."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from regkit.geometry.rotation import vector_to_matrix
from regkit.geometry.skinned_mesh import SkinnedMesh
from regkit.system.arrays import Indices

SPACING = 0.01
"""Distance of the rings of vertices along the forearm [m]."""

BENDING = 0.03
"""Length over which the wrist bends [m]."""

SWELLING, SWOLLEN = 0.3, 0.12
"""The forearm is thicker than the wrist by this fraction at this distance from it [m]."""

DOME = 0.006
"""Height of the skin that closes the end [m]."""


def with_forearm(
    mesh: SkinnedMesh, length: float, flexion: float = 0.0, deviation: float = 0.0
) -> SkinnedMesh:
    """Returns the mesh of a right hand without the hole at its wrist.

    The mesh of a hand ends at the wrist; a camera would see its inside through the hole.

    Args:
        mesh: The mesh, with one open border, around the wrist.
        length: Length of the forearm [m]; with 0 the wrist is closed.
        flexion: Angle of the hand to the forearm towards the palm [rad].
        deviation: Angle of the hand to the forearm towards the little finger [rad].
    """
    border = _border(mesh.faces)
    bone = mesh.bone("wrist.R")
    axes = mesh.rest[bone, :3, :3]
    # The bone's x axis points out of the back of the hand, y to the fingers, z to the thumb's side.
    turn = axes @ np.array([deviation, 0.0, -flexion])
    outline = mesh.vertices[border]
    middle = outline.mean(axis=0)
    count = max(1, round(length / SPACING)) if length else 0
    vertices, faces = [mesh.vertices], [mesh.faces]
    ring, past, made = border, 0.0, len(mesh.vertices)
    away = -axes[:, 1]
    for at in length * (1.0 + np.arange(count)) / max(count, 1):
        rotation = vector_to_matrix(min(at / BENDING, 1.0) * turn)
        away = -rotation @ axes[:, 1]
        middle = middle + (at - past) * away
        around = (outline - outline.mean(axis=0)) @ rotation.T
        # The outline of the wrist, which is oblique, becomes a cross-section.
        around -= min(at / BENDING, 1.0) * np.outer(around @ away, away)
        vertices.append(middle + (1.0 + SWELLING * min(at / SWOLLEN, 1.0)) * around)
        following = made + np.arange(len(ring))
        faces.append(_strip(ring, following))
        ring, past, made = following, float(at), made + len(ring)
    vertices.append((middle + DOME * away)[None])
    faces.append(np.column_stack([np.roll(ring, -1), ring, np.full(len(ring), made)]))
    added = made + 1 - len(mesh.vertices)
    alone = np.zeros((added, mesh.weights.shape[1]))
    alone[:, 0] = 1.0
    return replace(
        mesh,
        vertices=np.concatenate(vertices),
        faces=np.concatenate(faces),
        indices=np.concatenate([mesh.indices, np.full(alone.shape, bone)]),
        weights=np.concatenate([mesh.weights, alone]),
    )


def _border(faces: Indices) -> Indices:
    """Returns the vertices (B,) around the hole, in the order of the triangles' own edges."""
    edges = {tuple(edge) for face in faces for edge in zip(face, np.roll(face, -1), strict=True)}
    after = dict(edge for edge in edges if edge[::-1] not in edges)
    border = [min(after)]
    while (following := after[border[-1]]) != border[0]:
        border.append(following)
    return np.array(border)


def _strip(ring: Indices, following: Indices) -> Indices:
    """Returns the triangles (2 B, 3) between two rings (B,)."""
    one, other = np.roll(ring, -1), np.roll(following, -1)
    return np.concatenate(
        [np.column_stack([one, ring, following]), np.column_stack([one, following, other])]
    )
