"""Capsules in the place of a segment of a mesh."""

from __future__ import annotations

import numpy as np

from regkit.body.capsules import CapsuleParameters
from regkit.fitting.clusters import clusters, spread
from regkit.fitting.flesh import Flesh
from regkit.geometry.capsules import Capsules
from regkit.skeleton.description import CapsuleDescription
from regkit.system.arrays import Array

MOST = 3
"""Largest number of capsules of a segment."""

BETTER = 0.8
"""A further capsule has to reduce the distance from the surface to this part of it."""

FEWEST = 30
"""Least number of points for each of several capsules."""


def segment_capsules(part: Flesh) -> tuple[CapsuleDescription, ...]:
    """Returns one to three capsules that fill a segment.

    Each has the moments of the points in it. There are more of them as long as their union is much
    nearer to the surface, in the root mean square.

    Args:
        part: The segment in its frame; it needs points inside.
    """
    best = _filling(part.interior, 1)
    distance = _distance(best, part)
    for count in range(2, MOST + 1):
        if len(part.interior) < FEWEST * count:
            break
        capsules = _filling(part.interior, count)
        if (other := _distance(capsules, part)) < BETTER * distance:
            best, distance = capsules, other
    return tuple(CapsuleDescription(**one.model_dump()) for one in best)


def _filling(points: Array, count: int) -> list[CapsuleParameters]:
    """Returns capsules that fill clusters of points (N, 3) [m]."""
    owners = clusters(points, points[spread(points, count)])
    return [CapsuleParameters.fitted(points[owners == index]) for index in np.unique(owners)]


def _distance(capsules: list[CapsuleParameters], part: Flesh) -> float:
    """Returns the root mean square distance of the surface from a union of capsules [m]."""
    union = Capsules(
        np.zeros(len(capsules), dtype=np.intp),
        np.array([[one.start, one.end] for one in capsules]),
        np.array([np.broadcast_to(one.radius, 2) for one in capsules]),
    )
    squares = union.surface_distance(part.surface) ** 2
    return float(np.sqrt(part.areas @ squares / max(float(part.areas.sum()), 1e-12)))
