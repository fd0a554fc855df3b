"""Weakly constrained motions: those that slide a surface along itself."""

from __future__ import annotations

import numpy as np

from regkit.clouds import normals
from regkit.system.arrays import Array

MIN_CURVATURE = 0.01
"""Minimum eigenvalue of the mean point-to-plane Hessian of a constrained motion. Views of bodies
and hands, the bunny and a street scanned by LiDAR have 2.6 to 10 times as much, a plane with 2 % of
noise half of it, and a sphere next to nothing."""

NEIGHBOURS, PER_NEIGHBOURHOOD = 30, 15
"""Number of points of a normal's neighbourhood, or one in so many of a smaller cloud: with fewer
points, noise on a plane looks like curvature."""


def weak_motion(points: Array) -> str | None:
    """Describes the motion that a surface constrains least; None if it constrains all motions.

    The matrix is the Hessian of point-to-plane registration with lengths in radii of gyration:
    Gelfand et al., Geometrically stable sampling for the ICP algorithm, 2003, eq. 6.

    Args:
        points: Points of the surface, (N, 3) [m].
    """
    near = min(NEIGHBOURS, max(10, len(points) // PER_NEIGHBOURHOOD))
    directions = normals(points, near)
    arms = points - points.mean(axis=0)
    arms /= np.sqrt((arms**2).sum(axis=1).mean())
    rows = np.concatenate([directions, np.cross(arms, directions)], axis=1)
    values, vectors = np.linalg.eigh(rows.T @ rows / len(rows))
    if values[0] >= MIN_CURVATURE:
        return None
    shift, turn = vectors[:3, 0], vectors[3:, 0]
    if np.linalg.norm(turn) > np.linalg.norm(shift):
        return f"a rotation about the direction {_direction(turn)}"
    return f"a translation along {_direction(shift)}"


def _direction(vector: Array) -> str:
    unit = vector / np.linalg.norm(vector)
    return "(" + ", ".join(f"{value:.2f}" for value in unit + 0.0) + ")"
