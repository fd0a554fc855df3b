"""Which motions of a surface hardly show: those that slide it along itself."""

from __future__ import annotations

import numpy as np

from regkit.clouds import normals
from regkit.system.arrays import Array

SLACK = 0.01
"""A motion hardly shows if the surface gives way by less than this mean square part of it; the
least of a bunny and of a street scanned by LiDAR is six times as much, that of a plane with 2 % of
noise a little less, that of a sphere nothing."""


def hidden_motion(points: Array) -> str | None:
    """What motion of a surface (N, 3) hardly shows, in words; None if every one does.

    The matrix is that of point-to-plane registration with lengths in radii of gyration: Gelfand et
    al., Geometrically stable sampling for the ICP algorithm, 2003, eq. 6.
    """
    directions = normals(points)
    arms = points - points.mean(axis=0)
    arms /= np.sqrt((arms**2).sum(axis=1).mean())
    rows = np.concatenate([directions, np.cross(arms, directions)], axis=1)
    values, vectors = np.linalg.eigh(rows.T @ rows / len(rows))
    if values[0] >= SLACK:
        return None
    shift, turn = vectors[:3, 0], vectors[3:, 0]
    if np.linalg.norm(turn) > np.linalg.norm(shift):
        return f"a rotation about the direction {_told(turn)}"
    return f"a translation along {_told(shift)}"


def _told(vector: Array) -> str:
    unit = vector / np.linalg.norm(vector)
    return "(" + ", ".join(f"{value:.2f}" for value in unit + 0.0) + ")"
