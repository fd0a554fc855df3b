"""The motion-prior term, compiled; ``BoundMotionPrior`` is its readable form."""

from __future__ import annotations

import numpy as np

from regkit.interfaces.compiled import PriorArrays
from regkit.skeleton.arrays import PoseArrays, SkeletonArrays
from regkit.skeleton.compiled_difference import add_at_end, pose_difference
from regkit.system.compiled import compiled
from regkit.system.machine_types import Matrix, Vector


@compiled(reordered=True, python=False)
def respond_joints(
    skeleton: SkeletonArrays,
    prior: PriorArrays,
    pose: PoseArrays,
    numbers: Vector,
    table: Matrix,
    force: Vector,
    matrix: Matrix,
) -> float:
    """Returns ``1/2 d^T L d`` and adds its derivatives; the table is L of a pose alone, (n, n)."""
    dofs = len(force)
    stiffness = prior.stiffness if len(prior.stiffness) else table
    step = pose_difference(prior.pose, pose, dofs)
    energy, pull = 0.0, np.empty(dofs)
    for i in range(dofs):
        total = 0.0
        for j in range(dofs):
            total += stiffness[i, j] * step[j]
        pull[i] = total
        energy += 0.5 * step[i] * total
    # A force may be asked for without a matrix.
    for i in range(len(matrix)):
        for j in range(len(matrix)):
            matrix[i, j] += stiffness[i, j]
    rotations = 3 if skeleton.first == 6 else 0
    add_at_end(step, pull, force, rotations, dofs - len(pose.hinges))
    return energy
