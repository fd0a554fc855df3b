"""Derivatives of a rigid body's energy to a step, in a compiled loop."""

from __future__ import annotations

import numpy as np

from regkit.skeleton.compiled_steps import step_jacobian
from regkit.system.arrays import Array
from regkit.system.compiled import compiled


@compiled
def pulled_back(step: Array, transform: Array, wrench: Array, block: Array) -> tuple[Array, Array]:
    """Returns gradient (6,) and Gauss-Newton matrix (6, 6) to a step on the tangent space.

    The step's translation is in the world, and its rotation in the body's axes; see
    ``Skeleton.retract``.

    Args:
        step: The step, (6,).
        transform: T_world_body after the step, (4, 4).
        wrench: Derivative to the body's motion about its origin, in its axes, (6,).
        block: Second derivative to the same motion, (6, 6).
    """
    jacobian = step_jacobian(step, 3, 6)
    for i in range(3):
        for j in range(3):
            jacobian[i, j] = transform[j, i]
    gradient, half, matrix = np.zeros(6), np.zeros((6, 6)), np.zeros((6, 6))
    for i in range(6):
        for j in range(6):
            gradient[i] += jacobian[j, i] * wrench[j]
            for k in range(6):
                half[i, j] += block[i, k] * jacobian[k, j]
    for i in range(6):
        for j in range(6):
            for k in range(6):
                matrix[i, j] += jacobian[k, i] * half[k, j]
    return gradient, matrix
