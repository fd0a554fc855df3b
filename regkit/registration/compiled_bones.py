"""Primitives on bones, compiled: their places in a pose, and forces on the degrees of freedom.

The readable forms are ``Primitives.place``, ``Placed.accumulate`` and ``Placement``.
"""

from __future__ import annotations

import numpy as np

from regkit.primitives.accumulation import accumulated_stiffness, accumulated_wrenches
from regkit.primitives.arrays import PrimitiveArrays
from regkit.skeleton.arrays import PoseArrays, SkeletonArrays
from regkit.skeleton.compiled_placement import joint_twists, place_links
from regkit.system.compiled import compiled
from regkit.system.machine_types import Matrix, Stack, Vector


@compiled(python=False)
def placed_primitives(
    skeleton: SkeletonArrays,
    primitives: PrimitiveArrays,
    pose: PoseArrays,
    centres: Matrix,
    axes: Stack,
) -> Stack:
    """Writes centres (K, 3) [m] and axes (K, 3, 3) in a pose; returns T_world_link (L, 4, 4)."""
    links: Stack = place_links(
        skeleton.link_offsets,
        skeleton.link_parents,
        pose.root,
        skeleton.ball_links,
        pose.balls.reshape(1, len(pose.balls), 4),
        skeleton.hinge_links,
        skeleton.hinge_twists,
        pose.hinges.reshape(1, len(pose.hinges)),
    )[0]
    for k in range(len(centres)):
        t = links[skeleton.segment_links[primitives.segments[k]]]
        own, at = primitives.axes[k], primitives.centres[k]
        for i in range(3):
            x, y, z = t[i, 0], t[i, 1], t[i, 2]
            centres[k, i] = x * at[0] + y * at[1] + z * at[2] + t[i, 3]
            for j in range(3):
                axes[k, i, j] = x * own[0, j] + y * own[1, j] + z * own[2, j]
    return links


@compiled(python=False)
def force_on_bones(
    skeleton: SkeletonArrays,
    primitives: PrimitiveArrays,
    pose: PoseArrays,
    links: Stack,
    centres: Matrix,
    wrenches: Matrix,
    force: Vector,
) -> None:
    """Writes the generalised force (n,) of wrenches (K, 6) about the primitives' centres."""
    segments, count = len(skeleton.parents), len(centres)
    arms = np.empty((count, 3))
    for k in range(count):
        for i in range(3):
            arms[k, i] = centres[k, i] - pose.root[i, 3]
    sums = accumulated_wrenches(wrenches, arms, primitives.segments, segments)
    # A joint moves its segment and all that hang on it.
    for segment in range(segments - 1, 0, -1):
        parent = skeleton.parents[segment]
        for i in range(6):
            sums[parent, i] += sums[segment, i]
    twists = _twists(skeleton, pose, links, len(force))
    for dof in range(len(force)):
        own, total = sums[skeleton.dof_segments[dof]], 0.0
        for i in range(6):
            total += twists[dof, i] * own[i]
        force[dof] = total


@compiled(reordered=True, python=False)
def matrix_on_bones(
    skeleton: SkeletonArrays,
    primitives: PrimitiveArrays,
    pose: PoseArrays,
    links: Stack,
    centres: Matrix,
    stiffness: Stack,
    matrix: Matrix,
) -> None:
    """Writes the Gauss-Newton matrix (n, n) of blocks (K, 6, 6) about the primitives' centres."""
    segments, count, dofs = len(skeleton.parents), len(centres), len(matrix)
    arms = np.empty((count, 3))
    for k in range(count):
        for i in range(3):
            arms[k, i] = centres[k, i] - pose.root[i, 3]
    sums = accumulated_stiffness(stiffness, arms, primitives.segments, segments)
    for segment in range(segments - 1, 0, -1):
        parent = skeleton.parents[segment]
        for i in range(6):
            for j in range(6):
                sums[parent, i, j] += sums[segment, i, j]
    twists = _twists(skeleton, pose, links, dofs)
    loaded = np.empty(6)
    for dof in range(dofs):
        segment = skeleton.dof_segments[dof]
        for i in range(6):
            total = 0.0
            for j in range(6):
                total += sums[segment, i, j] * twists[dof, j]
            loaded[i] = total
        for other in range(dofs):
            if skeleton.dof_mask[other, segment] != 0.0:
                total = 0.0
                for i in range(6):
                    total += twists[other, i] * loaded[i]
                matrix[dof, other] = matrix[other, dof] = total
            elif skeleton.dof_mask[dof, skeleton.dof_segments[other]] == 0.0:
                matrix[dof, other] = 0.0


@compiled(python=False)
def _twists(skeleton: SkeletonArrays, pose: PoseArrays, links: Stack, dofs: int) -> Matrix:
    """Returns the world twist (n, 6) of each degree of freedom about the root's origin."""
    return joint_twists(
        links,
        skeleton.first,
        skeleton.ball_links,
        skeleton.hinge_links,
        skeleton.hinge_twists,
        dofs,
        pose.root,
    )
