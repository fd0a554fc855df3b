"""The fit of shape and poses to the data of several frames."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from regkit.body.linear_shape import LinearShape
from regkit.calibration.skin.measured_views import MeasuredFrame
from regkit.calibration.skin.posed_skin import PosedSkin
from regkit.calibration.skin.problem import SkinProblem
from regkit.calibration.skin.skin_points import SkinPoints
from regkit.interfaces import Solver
from regkit.skeleton import Pose
from regkit.system.arrays import Array

WIDE = (0.03, 0.015, 0.0)
"""Least cutoffs of distances in the fits that follow each other, as fractions of the body's size: a
part of the wrong length is first drawn from afar."""

CUTOFF = 2.0
"""Cutoff of distances in units of the median of the data's, which covers noise and misfit."""

SMALLEST_CUTOFF = 0.002
"""Least cutoff of all, as a fraction of the body's size."""


@dataclass(frozen=True)
class SkinFit:
    """A shape and the poses in several frames.

    Attributes:
        coefficients: The shape's coefficients, (P,).
        poses: The poses, (F,).
    """

    coefficients: Array
    poses: tuple[Pose, ...]


def fitted(
    shape: LinearShape,
    start: Array,
    frames: Sequence[MeasuredFrame],
    poses: Sequence[Pose],
    solver: Solver,
) -> SkinFit:
    """Returns the most probable shape and poses.

    Args:
        shape: The template's shape.
        start: Initial coefficients, (P,).
        frames: Data of F frames.
        poses: Initial poses of the body in these frames.
        solver: The solver.
    """
    found = SkinFit(start, tuple(poses))
    for wide in WIDE:
        gaps = np.abs(skin_distances(shape, found.coefficients, frames, found.poses))
        least = max(wide, SMALLEST_CUTOFF) * shape.size(found.coefficients)
        cutoff = max(CUTOFF * float(np.median(gaps)), least)
        problem = SkinProblem(shape, found.coefficients, frames, found.poses, cutoff)
        x = solver.minimize(problem).x
        found = SkinFit(problem.coefficients(x), problem.poses(x))
    return found


def skin_distances(
    shape: LinearShape, x: Array, frames: Sequence[MeasuredFrame], poses: Sequence[Pose]
) -> Array:
    """Returns the signed distances of the data of all frames to the skin, (N,) [m].

    Args:
        shape: The template's shape.
        x: Its coefficients, (P,).
        frames: Data of F frames.
        poses: Poses of the body in these frames.
    """
    points, size = SkinPoints.on(shape.mesh.faces), shape.size(x)
    return np.concatenate(
        [
            frame.distances(points, PosedSkin.of(shape, x, pose).vertices, size)[0].lengths
            for frame, pose in zip(frames, poses, strict=True)
        ]
    )
