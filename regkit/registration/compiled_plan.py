"""The energy of a whole method and its derivatives to the degrees of freedom, compiled.

This is the chain rule of ``RegistrationProblem`` without a call between its links. The parts are
called by their addresses, so that nothing here is compiled anew for another method.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from regkit.interfaces.compiled import (
    BIND,
    EXPLAIN,
    RESPOND,
    RESPOND_JOINTS,
    WEIGH,
    SceneArrays,
)
from regkit.primitives.accumulation import accumulated_stiffness, accumulated_wrenches
from regkit.primitives.arrays import PrimitiveArrays
from regkit.skeleton.arrays import PoseArrays, SkeletonArrays
from regkit.skeleton.compiled_placement import joint_twists, place_links
from regkit.system.compiled import compiled
from regkit.system.machine_types import (
    IntegerMatrix,
    IntegerVector,
    Matrix,
    Stack,
    Vector,
)


class PlanArrays(NamedTuple):
    """The parts of a method, bound to a body: first energies, then weights, then joint energies.

    Attributes:
        energies: Number of energies; the first is the kernel.
        weights: Number of parts that weight the primitives.
        functions: Addresses of ``bind``, ``respond`` (or ``weigh``) and ``explain``, (P, 3); 0 for
            none.
        numbers: Numbers of each part, (P, C).
        table: Tables of all parts, (R, D).
        table_rows: First row of each part's table, and the end, (P + 1,).
        state_rows: First row of each part's state, and the end, (P + 1,).
    """

    energies: int
    weights: int
    functions: IntegerMatrix
    numbers: Matrix
    table: Matrix
    table_rows: IntegerVector
    state_rows: IntegerVector


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
        skeleton.hinge_axes,
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


@compiled
def bind_to_best(
    plan: PlanArrays,
    skeleton: SkeletonArrays,
    scene: SceneArrays,
    roots: Stack,
    balls: Stack,
    hinges: Matrix,
    states: Matrix,
) -> int:
    """Binds all parts at the candidate with the least energy of the kernel; returns its index.

    All candidates are compared with the kernel bound to the first one.

    Args:
        plan: The parts.
        skeleton: The skeleton.
        scene: The scene, whose placement and weights are written.
        roots: T_world_root of C candidates, (C, 4, 4).
        balls: Quaternions of their ball joints, (C, n_ball, 4).
        hinges: Angles of their hinges, (C, n_hinge) [rad].
        states: States of the parts, written.
    """
    bind_parts(plan, skeleton, scene, PoseArrays(roots[0], balls[0], hinges[0]), states)
    best, least = 0, np.inf
    for candidate in range(len(roots) if len(roots) > 1 else 0):
        pose = PoseArrays(roots[candidate], balls[candidate], hinges[candidate])
        energy = kernel_energy(plan, skeleton, scene, pose, states)
        if energy < least:
            best, least = candidate, energy
    if best:
        bind_parts(
            plan, skeleton, scene, PoseArrays(roots[best], balls[best], hinges[best]), states
        )
    return best


@compiled(python=False)
def bind_parts(
    plan: PlanArrays, skeleton: SkeletonArrays, scene: SceneArrays, pose: PoseArrays, states: Matrix
) -> None:
    """Binds all parts at a pose: writes the scene's placement and weights, and the states."""
    placed_primitives(skeleton, scene.primitives, pose, scene.centres, scene.axes)
    for k in range(len(scene.weights)):
        scene.weights[k] = scene.primitives.weights[k]
    factors = np.empty(len(scene.weights))
    for part in range(plan.energies, plan.energies + plan.weights):
        table = plan.table[plan.table_rows[part] : plan.table_rows[part + 1]]
        WEIGH(plan.functions[part, 1], scene, plan.numbers[part], table, factors)
        for k in range(len(factors)):
            scene.weights[k] *= factors[k]
    for part in range(plan.energies):
        if plan.functions[part, 0] != 0:
            table = plan.table[plan.table_rows[part] : plan.table_rows[part + 1]]
            state = states[plan.state_rows[part] : plan.state_rows[part + 1]]
            BIND(plan.functions[part, 0], scene, plan.numbers[part], table, state)


@compiled(python=False)
def kernel_energy(
    plan: PlanArrays, skeleton: SkeletonArrays, scene: SceneArrays, pose: PoseArrays, states: Matrix
) -> float:
    """Returns the energy of the kernel alone in a pose."""
    count = len(scene.weights)
    centres, axes = np.empty((count, 3)), np.empty((count, 3, 3))
    placed_primitives(skeleton, scene.primitives, pose, centres, axes)
    wrenches, stiffness = np.empty((0, 6)), np.empty((0, 6, 6))
    table, state = plan.table[: plan.table_rows[1]], states[: plan.state_rows[1]]
    address, numbers = plan.functions[0, 1], plan.numbers[0]
    energy: float = RESPOND(
        address, scene, centres, axes, numbers, table, state, 0, wrenches, stiffness
    )
    return energy


@compiled
def explained(
    plan: PlanArrays,
    skeleton: SkeletonArrays,
    scene: SceneArrays,
    pose: PoseArrays,
    states: Matrix,
    probability: Vector,
) -> None:
    """Writes the inlier probability of each point in a pose, (N,)."""
    count = len(scene.weights)
    centres, axes = np.empty((count, 3)), np.empty((count, 3, 3))
    placed_primitives(skeleton, scene.primitives, pose, centres, axes)
    table, state = plan.table[: plan.table_rows[1]], states[: plan.state_rows[1]]
    address, numbers = plan.functions[0, 2], plan.numbers[0]
    EXPLAIN(address, scene, centres, axes, numbers, table, state, probability)


@compiled
def derivatives(
    plan: PlanArrays,
    skeleton: SkeletonArrays,
    scene: SceneArrays,
    prior: PoseArrays,
    pose: PoseArrays,
    states: Matrix,
    order: int,
    force: Vector,
    matrix: Matrix,
) -> float:
    """Returns the energy of a pose and writes its derivatives to the degrees of freedom.

    Args:
        plan: The parts.
        skeleton: The skeleton.
        scene: The scene to which the parts are bound.
        prior: Pose to which unobserved joints stay close.
        pose: The pose.
        states: States of the parts.
        order: 0 for the energy alone, 1 for the force too, 2 for the matrix too.
        force: Written, (n,).
        matrix: Gauss-Newton matrix, written, (n, n).
    """
    count = len(scene.weights)
    centres, axes = np.empty((count, 3)), np.empty((count, 3, 3))
    links = placed_primitives(skeleton, scene.primitives, pose, centres, axes)
    wrenches, stiffness = np.zeros((count, 6)), np.zeros((count, 6, 6))
    energy = 0.0
    for part in range(plan.energies):
        table = plan.table[plan.table_rows[part] : plan.table_rows[part + 1]]
        state = states[plan.state_rows[part] : plan.state_rows[part + 1]]
        address, numbers = plan.functions[part, 1], plan.numbers[part]
        energy += RESPOND(
            address, scene, centres, axes, numbers, table, state, order, wrenches, stiffness
        )
    if order:
        force_on_bones(skeleton, scene.primitives, pose, links, centres, wrenches, force)
    if order == 2:
        matrix_on_bones(skeleton, scene.primitives, pose, links, centres, stiffness, matrix)
    for part in range(plan.energies + plan.weights, len(plan.functions)):
        table = plan.table[plan.table_rows[part] : plan.table_rows[part + 1]]
        address, numbers = plan.functions[part, 1], plan.numbers[part]
        energy += RESPOND_JOINTS(address, skeleton, prior, pose, numbers, table, force, matrix)
    return energy


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
        skeleton.hinge_axes,
        dofs,
        pose.root,
    )
