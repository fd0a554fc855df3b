"""The registration problem over steps on the tangent space, compiled.

The readable forms are ``TangentCoordinates`` and ``RegistrationProblem``.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from regkit.interfaces.compiled import PriorArrays, SceneArrays
from regkit.registration.compiled_plan import PlanArrays, derivatives
from regkit.skeleton.arrays import LimitArrays, PoseArrays, SkeletonArrays
from regkit.skeleton.compiled_steps import (
    ball_steps,
    retracted_balls,
    retracted_root,
    step_jacobian,
    within_limits,
)
from regkit.system.compiled import compiled
from regkit.system.machine_types import Matrix, Vector


class ProblemArrays(NamedTuple):
    """A method bound to a body and a frame, and the pose from which it starts.

    Attributes:
        plan: The parts.
        skeleton: The skeleton.
        scene: The scene to which the parts are bound.
        prior: What is known of the pose before the frame.
        start: Pose at the origin of the coordinates.
        states: States of the parts.
        lower: Lower bounds of the coordinates, (m,).
        upper: Upper bounds, (m,).
    """

    plan: PlanArrays
    skeleton: SkeletonArrays
    scene: SceneArrays
    prior: PriorArrays
    start: PoseArrays
    states: Matrix
    lower: Vector
    upper: Vector


@compiled(python=False)
def whole_step(limits: LimitArrays, hinges: int, x: Vector) -> Vector:
    """Returns the step (n,) of all degrees of freedom at x (m,), with those of coupled hinges.

    Args:
        limits: The couplings.
        hinges: Index of the first hinge in both.
        x: Coordinates, (m,).
    """
    step = np.empty(hinges + len(limits.leaders))
    for dof in range(hinges):
        step[dof] = x[dof]
    for hinge in range(len(limits.leaders)):
        step[hinges + hinge] = limits.ratios[hinge] * x[hinges + limits.variables[hinge]]
    return step


@compiled(python=False)
def coupled_hinges(limits: LimitArrays, hinges: Vector) -> Vector:
    """Returns angles (n_hinge,) [rad] with the followers set from their leaders."""
    coupled = np.empty(len(hinges))
    for hinge in range(len(hinges)):
        coupled[hinge] = hinges[hinge]
        if limits.leaders[hinge] != hinge:
            leader = hinges[limits.leaders[hinge]]
            coupled[hinge] = limits.ratios[hinge] * leader + limits.offsets[hinge]
    return coupled


@compiled(python=False)
def pose_at(skeleton: SkeletonArrays, start: PoseArrays, x: Vector) -> PoseArrays:
    """Returns the pose at coordinates x (m,)."""
    first, count = skeleton.first, len(start.balls)
    hinges = first + 3 * count
    turns = np.empty((count, 3))
    for ball in range(count):
        for i in range(3):
            turns[ball, i] = x[first + 3 * ball + i]
    root = retracted_root(start.root, x) if first == 6 else start.root.copy()
    angles = np.empty(len(start.hinges))
    for hinge in range(len(angles)):
        step = skeleton.limits.ratios[hinge] * x[hinges + skeleton.limits.variables[hinge]]
        angles[hinge] = start.hinges[hinge] + step
    balls = retracted_balls(start.balls, turns)
    return PoseArrays(root, balls, coupled_hinges(skeleton.limits, angles))


@compiled(python=False)
def project(skeleton: SkeletonArrays, start: PoseArrays, x: Vector) -> None:
    """Replaces x (m,) by the coordinates of its pose, projected onto all limits."""
    limits, pose = skeleton.limits, pose_at(skeleton, start, x)
    first = skeleton.first
    balls, turned = within_limits(
        pose.balls, limits.centres, limits.twist_axes, limits.cones, limits.twists
    )
    if turned:
        steps = ball_steps(start.balls, balls)
        for ball in range(len(balls)):
            for i in range(3):
                x[first + 3 * ball + i] = steps[ball, i]
    for hinge in range(len(pose.hinges)):
        if limits.leaders[hinge] != hinge:
            continue
        angle = pose.hinges[hinge]
        inside = min(max(angle, limits.hinges[hinge, 0]), limits.hinges[hinge, 1])
        if inside != angle:
            at = first + 3 * len(balls) + limits.variables[hinge]
            x[at] = inside - start.hinges[hinge]


@compiled(python=False)
def equations(problem: ProblemArrays, x: Vector, gradient: Vector, matrix: Matrix) -> float:
    """Returns the energy at x (m,) and writes its gradient (m,) and Gauss-Newton matrix (m, m)."""
    skeleton = problem.skeleton
    pose = pose_at(skeleton, problem.start, x)
    dofs = len(skeleton.dof_segments)
    force, square = np.empty(dofs), np.empty((dofs, dofs))
    energy = derivatives(
        problem.plan,
        skeleton,
        problem.scene,
        problem.prior,
        pose,
        problem.states,
        2,
        force,
        square,
    )
    first = skeleton.first
    hinges = first + 3 * len(pose.balls)
    _through_rotations(x, 3 if first == 6 else 0, hinges, force, square)
    through_couplings(skeleton.limits, hinges, force, square, gradient, matrix)
    return energy


@compiled(python=False)
def _through_rotations(x: Vector, first: int, last: int, force: Vector, square: Matrix) -> None:
    """Applies D^T f and D^T H D with the right Jacobians of the rotation vectors in x, in place."""
    blocks = step_jacobian(x, first, last)
    dofs = len(force)
    for a in range(first, last, 3):
        for row in range(dofs):
            u, v, w = square[row, a], square[row, a + 1], square[row, a + 2]
            for i in range(a, a + 3):
                square[row, i] = u * blocks[a, i] + v * blocks[a + 1, i] + w * blocks[a + 2, i]
    for a in range(first, last, 3):
        for column in range(dofs):
            u, v, w = square[a, column], square[a + 1, column], square[a + 2, column]
            for i in range(a, a + 3):
                square[i, column] = u * blocks[a, i] + v * blocks[a + 1, i] + w * blocks[a + 2, i]
        u, v, w = force[a], force[a + 1], force[a + 2]
        for i in range(a, a + 3):
            force[i] = u * blocks[a, i] + v * blocks[a + 1, i] + w * blocks[a + 2, i]


@compiled(python=False)
def through_couplings(
    limits: LimitArrays,
    hinges: int,
    force: Vector,
    square: Matrix,
    gradient: Vector,
    matrix: Matrix,
) -> None:
    """Writes the gradient (m,) and the matrix (m, m) on the independent degrees of freedom."""
    dofs, count = len(force), len(gradient)
    if count == dofs:
        for i in range(dofs):
            gradient[i] = force[i]
            for j in range(dofs):
                matrix[i, j] = square[i, j]
        return
    for i in range(count):
        gradient[i] = 0.0
        for j in range(count):
            matrix[i, j] = 0.0
    for i in range(dofs):
        a, share = i, 1.0
        if i >= hinges:
            a, share = hinges + limits.variables[i - hinges], limits.ratios[i - hinges]
        gradient[a] += share * force[i]
        for j in range(dofs):
            b, other = j, 1.0
            if j >= hinges:
                b, other = hinges + limits.variables[j - hinges], limits.ratios[j - hinges]
            matrix[a, b] += share * other * square[i, j]
