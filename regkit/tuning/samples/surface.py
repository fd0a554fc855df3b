"""What a camera sees of a body: its mesh, or its capsules as triangles."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from regkit.body import Body
from regkit.geometry.capsules import Capsules
from regkit.geometry.surface import SkinnedSurface
from regkit.system.arrays import Array, Indices
from regkit.tuning.samples.holes import closed

AROUND = 16
"""Vertices around a capsule: between them the surface is up to 2 % of the radius too near."""

RINGS = 4
"""Circles of vertices on the cap of a capsule, the last of which bounds its cone."""


def rendered_surface(body: Body) -> SkinnedSurface:
    """Returns the surface with triangles that stands for a body in depth images.

    It is the body's mesh if it has one, with its holes closed, since a camera never sees the inside
    of a body; otherwise its capsules, each a closed mesh of its own.
    """
    if body.surface is not None and len(body.surface.faces):
        return replace(body.surface, faces=closed(body.surface.faces))
    return capsule_surface(body.capsules)


def capsule_surface(capsules: Capsules) -> SkinnedSurface:
    """Returns closed meshes of tapered capsules (C), with all vertices on their surfaces.

    A capsule is the envelope of spheres. A unit vector n is the normal of its surface on the second
    sphere if n.u > sin(a), and on the first otherwise, with the direction u of the axis and
    sin(a) = (r_1 - r_2) / length. The normals at sin(a) belong to the circles that bound the cone.

    Args:
        capsules: The capsules, in the frames of their segments.
    """
    ends, radii = _apart(capsules)
    lengths = np.linalg.norm(ends[:, 1] - ends[:, 0], axis=1)
    sines = (radii[:, 0] - radii[:, 1]) / np.where(lengths > 0.0, lengths, np.inf)
    border = np.arccos(np.clip(sines, -1.0, 1.0))
    share = np.arange(RINGS + 1) / RINGS
    # Angles between normal and axis, (C, 2, RINGS + 1): from the pole of each sphere to the border.
    angles = np.stack([np.pi + share * (border[:, None] - np.pi), share * border[:, None]], axis=1)
    along, across = np.cos(angles), np.sin(angles)
    turn = 2.0 * np.pi * np.arange(AROUND) / AROUND
    flat = np.stack([np.cos(turn), np.zeros(AROUND), np.sin(turn)], axis=1)
    local = across[..., None, None] * flat + along[..., None, None] * np.array([0.0, 1.0, 0.0])
    local[:, :, 0] = along[:, :, :1, None] * np.array([0.0, 1.0, 0.0])
    normals = np.einsum("cij,csrvj->csrvi", capsules.frames(), local)
    vertices = ends[:, :, None, None] + radii[:, :, None, None, None] * normals
    # A pole is one vertex.
    whole = vertices.reshape(len(capsules), -1, 3)
    kept, faces = _faces()
    points = whole[:, kept].reshape(-1, 1, 3)
    shifts = len(kept) * np.arange(len(capsules))
    return SkinnedSurface(
        segments=np.repeat(capsules.segments, len(kept))[:, None],
        points=points,
        blend=np.ones((len(points), 1)),
        normals=normals.reshape(len(capsules), -1, 3)[:, kept].reshape(-1, 1, 3),
        faces=(faces + shifts[:, None, None]).reshape(-1, 3),
    )


def _apart(capsules: Capsules) -> tuple[Array, Array]:
    """Returns ends (C, 2, 3) and radii (C, 2), with an end within the other's sphere as that."""
    ends, radii = capsules.ends.copy(), capsules.radii.copy()
    lengths = np.linalg.norm(ends[:, 1] - ends[:, 0], axis=1)
    for large, small in ((0, 1), (1, 0)):
        within = radii[:, large] >= radii[:, small] + lengths
        ends[within, small], radii[within, small] = ends[within, large], radii[within, large]
    return ends, radii


def _faces() -> tuple[Indices, Indices]:
    """Returns which of a capsule's 2 (RINGS + 1) AROUND places are vertices, and its triangles.

    A circle 0 is a pole, of which only the first place is a vertex.
    """
    rings = RINGS + 1
    places = np.arange(2 * rings * AROUND).reshape(2, rings, AROUND)
    places[:, 0] = places[:, 0, :1]
    # Circles from the pole of the first sphere to that of the second.
    circles = np.concatenate([places[0], places[1, ::-1]])
    low, high = circles[:-1], circles[1:]
    low_next, high_next = np.roll(low, -1, axis=1), np.roll(high, -1, axis=1)
    faces = np.concatenate([
        np.stack([low, high, high_next], axis=-1).reshape(-1, 3),
        np.stack([low, high_next, low_next], axis=-1).reshape(-1, 3),
    ])  # fmt: skip
    different = (faces != np.roll(faces, 1, axis=1)).all(axis=1)
    kept, numbers = np.unique(faces[different], return_inverse=True)
    return kept, numbers.reshape(-1, 3)
