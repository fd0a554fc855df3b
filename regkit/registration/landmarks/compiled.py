"""The energy of landmarks, compiled; ``LandmarkEnergy`` is its readable form."""

from __future__ import annotations

from math import sqrt

import numpy as np

from regkit.interfaces.compiled import PriorArrays
from regkit.registration.compiled_robust import write_losses
from regkit.registration.landmarks.table import (
    CENTRE,
    FOCAL,
    POINT,
    SCALE,
    SEGMENT,
    TARGET,
    WEIGHT,
)
from regkit.skeleton.arrays import PoseArrays, SkeletonArrays
from regkit.skeleton.compiled_placement import joint_twists, place_links
from regkit.system.compiled import compiled
from regkit.system.machine_types import Matrix, Vector

NEAREST = 0.05
"""Least depth of a marker before the camera at which its projection follows the depth [m]."""


@compiled(python=False)
def respond_joints(
    skeleton: SkeletonArrays,
    prior: PriorArrays,
    pose: PoseArrays,
    numbers: Vector,
    table: Matrix,
    force: Vector,
    matrix: Matrix,
) -> float:
    """Returns ``sum w rho(|r| / s)`` over the table's landmarks and adds its derivatives."""
    measured = 0
    for mark in range(len(table)):
        if table[mark, WEIGHT] > 0.0:
            measured += 1
    if measured == 0:
        return 0.0
    links = place_links(
        skeleton.link_offsets,
        skeleton.link_parents,
        pose.root,
        skeleton.ball_links,
        pose.balls.reshape(1, len(pose.balls), 4),
        skeleton.hinge_links,
        skeleton.hinge_twists,
        pose.hinges.reshape(1, len(pose.hinges)),
    )[0]
    dofs = len(force)
    twists = joint_twists(
        links,
        skeleton.first,
        skeleton.ball_links,
        skeleton.hinge_links,
        skeleton.hinge_twists,
        dofs,
        pose.root,
    )
    size, loss, weight = np.empty(1, np.float32), np.empty(1, np.float32), np.empty(1, np.float32)
    arm, values, slopes = np.empty(3), np.empty(3), np.empty((3, 3))
    rows, moved = np.empty((dofs, 3)), np.empty(3)
    energy = 0.0
    for mark in range(len(table)):
        if table[mark, WEIGHT] == 0.0:
            continue
        segment = int(table[mark, SEGMENT])
        carrier = links[skeleton.segment_links[segment]]
        for i in range(3):
            place = carrier[i, 3]
            for j in range(3):
                place += carrier[i, j] * table[mark, POINT + j]
            arm[i] = place - pose.root[i, 3]
        square = _residual(table, mark, pose.root, arm, values, slopes)
        size[0] = sqrt(square)
        write_losses(numbers[0], size, 1.0, loss, weight)
        energy += table[mark, WEIGHT] * loss[0]
        pull = table[mark, WEIGHT] * weight[0]
        for dof in range(dofs):
            if skeleton.dof_mask[dof, segment] == 0.0:
                continue
            for i in range(3):
                j, k = (i + 1) % 3, (i + 2) % 3
                moved[i] = (
                    twists[dof, i] + twists[dof, 3 + j] * arm[k] - twists[dof, 3 + k] * arm[j]
                )
            slope = 0.0
            for i in range(3):
                rows[dof, i] = (
                    slopes[i, 0] * moved[0] + slopes[i, 1] * moved[1] + slopes[i, 2] * moved[2]
                )
                slope += rows[dof, i] * values[i]
            force[dof] += pull * slope
            for other in range(dof + 1):
                if skeleton.dof_mask[other, segment] != 0.0:
                    entry = pull * (
                        rows[dof, 0] * rows[other, 0]
                        + rows[dof, 1] * rows[other, 1]
                        + rows[dof, 2] * rows[other, 2]
                    )
                    matrix[dof, other] += entry
                    if other != dof:
                        matrix[other, dof] += entry
    return energy


@compiled(python=False)
def _residual(
    table: Matrix, mark: int, root: Matrix, arm: Vector, values: Vector, slopes: Matrix
) -> float:
    """Writes a residual (3,) in units of its error and its derivative (3, 3); returns its square.

    Args:
        table: The landmarks.
        mark: Row of the landmark.
        root: T_world_root, (4, 4).
        arm: Vector from the root's origin to the marker, (3,) [m].
        values: Written, (3,).
        slopes: Written, (3, 3) [1/m].
    """
    scale, square = table[mark, SCALE], 0.0
    z = root[2, 3] + arm[2]
    depth = max(z, NEAREST)
    for i in range(3):
        place = root[i, 3] + arm[i]
        for j in range(3):
            slopes[i, j] = 0.0
        if table[mark, FOCAL] == 0.0:
            slopes[i, i] = 1.0 / scale
        elif i == 2:
            place = table[mark, TARGET + i]
        else:
            focal, across = table[mark, FOCAL + i], place / depth
            slopes[i, i] = focal / depth / scale
            if z > NEAREST:
                slopes[i, 2] = -focal * across / depth / scale
            place = focal * across + table[mark, CENTRE + i]
        values[i] = (place - table[mark, TARGET + i]) / scale
        square += values[i] * values[i]
    return square
