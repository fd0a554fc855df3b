"""The continuity term, compiled; ``BoundContinuity`` is its readable form."""

from __future__ import annotations

from regkit.interfaces.compiled import PriorArrays
from regkit.skeleton.arrays import PoseArrays, SkeletonArrays
from regkit.skeleton.compiled_steps import ball_steps
from regkit.system.compiled import compiled
from regkit.system.machine_types import Matrix, Vector


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
    """Returns ``1/2 sum w r^2`` and adds its derivatives; the table holds the weights w (n, 1)."""
    energy = 0.0
    steps = ball_steps(prior.pose.balls, pose.balls)
    dof = skeleton.first
    for ball in range(len(pose.balls)):
        for i in range(3):
            pull = table[dof, 0] * steps[ball, i]
            energy += 0.5 * pull * steps[ball, i]
            force[dof] += pull
            matrix[dof, dof] += table[dof, 0]
            dof += 1
    for hinge in range(len(pose.hinges)):
        step = pose.hinges[hinge] - prior.pose.hinges[hinge]
        energy += 0.5 * table[dof, 0] * step * step
        force[dof] += table[dof, 0] * step
        matrix[dof, dof] += table[dof, 0]
        dof += 1
    return energy
