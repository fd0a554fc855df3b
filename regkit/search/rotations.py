"""Rigid alignment from any orientation: the best of many rotations, each registered roughly."""

from __future__ import annotations

from itertools import product

import numpy as np

from regkit.body.cloud import cloud_body
from regkit.clouds import spacing, voxel_downsampled, voxel_for
from regkit.clouds.agreement import Agreements
from regkit.geometry.rigid import rigid
from regkit.geometry.rotation import to_matrix
from regkit.interfaces import Method
from regkit.observation import Observation
from regkit.system.arrays import Array

SKETCH = 400
"""Number of points that are registered from every rotation."""


def by_rotations(source: Array, target: Array, method: Method) -> tuple[Array, str]:
    """Returns the best T_target_source (4, 4) of a method from many rotations, and a comment.

    The centroids are aligned and both clouds are downsampled. Fitness and overlap at the spacing
    of neighbouring points rank the results, so that a method need not report an energy.

    Args:
        source: Source points, (N, 3) [m].
        target: Target points, (M, 3) [m].
        method: Registration method.

    Raises:
        RegkitError: If the method cannot register such a cloud.
    """
    few, seen = _sketch(source), _sketch(target)
    centre, aim = few.mean(axis=0), seen.mean(axis=0)
    body = cloud_body("source", few - centre)
    registrar = method.bind(body)
    observation = Observation(seen, np.ones(len(seen)), np.full(len(seen), spacing(seen) ** 2))
    distance = max(spacing(few), spacing(seen))
    back = rigid(np.eye(3), -centre)
    starts = [body.skeleton.rest(rigid(rotation, aim)) for rotation in icosahedral()]
    best, score = np.eye(4), -1.0
    agreements = Agreements.of(few, seen)
    for found in registrar.register_each(observation, starts):
        transform = found.pose.root @ back
        its = agreements.after(transform, distance)
        if its.fitness + its.overlap > score:
            best, score = transform, its.fitness + its.overlap
    return best, f"the best of {len(starts)} rotations, each registered with {len(few)} points"


def icosahedral() -> Array:
    """Returns the 60 rotations of the icosahedron, (60, 3, 3).

    No rotation is farther than 45 deg from the nearest of them.

    Source: Conway and Smith, On Quaternions and Octonions, 2003, section 3.5 (the icosians).
    """
    golden = (1.0 + np.sqrt(5.0)) / 2.0
    even = [(0, 1, 2, 3), (0, 2, 3, 1), (0, 3, 1, 2), (1, 0, 3, 2), (1, 2, 0, 3), (1, 3, 2, 0)]
    even += [(2, 0, 1, 3), (2, 1, 3, 0), (2, 3, 0, 1), (3, 0, 2, 1), (3, 1, 0, 2), (3, 2, 1, 0)]
    units = [2.0 * np.eye(4)[axis] for axis in range(4)]
    units += [np.array([1.0, *signs]) for signs in product((1.0, -1.0), repeat=3)]
    for a, b, c in product((1.0, -1.0), repeat=3):
        values = np.array([0.0, a * 1.0, b * golden, c / golden])
        units += [values[list(order)] for order in even]
    # A quaternion and its negative are the same rotation.
    unique = {
        tuple(np.round(q * np.sign(q[np.flatnonzero(np.abs(q) > 1e-9)[0]]), 9)): q for q in units
    }
    return to_matrix(np.array(list(unique.values())) / 2.0)


def _sketch(points: Array) -> Array:
    voxel = voxel_for(points, SKETCH)
    return points if voxel is None else voxel_downsampled(points, voxel)
