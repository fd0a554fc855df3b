"""Triangle meshes of tapered capsules, for display."""

from __future__ import annotations

import numpy as np

from regkit.geometry.capsules import Capsules
from regkit.system.arrays import Array, Indices

AROUND = 16
"""Number of vertices of a ring."""

RINGS = 5
"""Number of rings between the pole and the seam of an end sphere."""


def capsule_mesh(capsules: Capsules) -> tuple[Array, Indices, Indices]:
    """Returns the triangle mesh of at least one capsule.

    The vertices are the support points of a capsule for directions on a sphere; the ring at the
    seam between the end spheres occurs twice.

    Returns:
        Vertices (V, 3) [m], triangles (F, 3), and the index of each vertex's capsule (V,).
    """
    parts = [_one(ends, radii) for ends, radii in zip(capsules.ends, capsules.radii, strict=True)]
    count = (2 * RINGS + 2) * AROUND
    firsts = count * np.arange(len(parts))[:, None, None]
    return (
        np.concatenate(parts),
        (firsts + _triangles_of_rings()).reshape(-1, 3),
        np.repeat(np.arange(len(parts)), count),
    )


def _one(ends: Array, radii: Array) -> Array:
    """Returns the vertices of one capsule, ((2 RINGS + 2) AROUND, 3) [m]."""
    axis = ends[1] - ends[0]
    length = float(np.linalg.norm(axis))
    larger = int(radii[1] > radii[0])
    if length <= abs(float(radii[1] - radii[0])):
        # One sphere contains the other: the capsule is the larger sphere.
        ends, radii = np.repeat(ends[larger : larger + 1], 2, axis=0), np.full(2, radii[larger])
        axis, length = np.array([0.0, 0.0, 1.0]), 0.0
    along = axis / np.linalg.norm(axis)
    seam = np.arcsin((radii[0] - radii[1]) / length) if length > 0.0 else 0.0
    first = np.linspace(-0.5 * np.pi, seam, RINGS + 1)
    second = np.linspace(seam, 0.5 * np.pi, RINGS + 1)
    side = np.cross(along, np.eye(3)[np.argmin(np.abs(along))])
    side /= np.linalg.norm(side)
    angles = 2.0 * np.pi * np.arange(AROUND) / AROUND
    ring = np.outer(np.cos(angles), side) + np.outer(np.sin(angles), np.cross(along, side))
    vertices = [
        end + radius * (np.sin(latitude) * along + np.cos(latitude) * ring)
        for end, radius, latitudes in zip(ends, radii, (first, second), strict=True)
        for latitude in latitudes
    ]
    return np.concatenate(vertices)


def _triangles_of_rings() -> Indices:
    """Returns two triangles per quad between adjacent rings, counter-clockwise from outside."""
    rings = AROUND * np.arange(2 * RINGS + 1)[:, None]
    here = np.arange(AROUND)[None]
    there = (here + 1) % AROUND
    a, b = rings + here, rings + there
    c, d = b + AROUND, a + AROUND
    corners = np.stack([np.stack([a, b, c], axis=-1), np.stack([a, c, d], axis=-1)])
    return corners.reshape(-1, 3)
