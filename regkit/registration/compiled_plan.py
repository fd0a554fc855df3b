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
    PriorArrays,
    SceneArrays,
)
from regkit.registration.compiled_bones import (
    force_on_bones,
    matrix_on_bones,
    placed_primitives,
)
from regkit.skeleton.arrays import PoseArrays, SkeletonArrays
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


@compiled
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
    prior: PriorArrays,
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
        prior: What is known of the pose before the frame.
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
