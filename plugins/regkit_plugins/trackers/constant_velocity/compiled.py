"""Repetition of the last motion in a compiled loop."""

from __future__ import annotations

from math import sqrt

import numpy as np

from regkit.skeleton.compiled_rotation import hamilton_product
from regkit.system.arrays import Array
from regkit.system.compiled import compiled


@compiled
def repeated_motion(
    before_root: Array, before_balls: Array, last_root: Array, last_balls: Array
) -> tuple[Array, Array]:
    """Returns the root (4, 4) and the ball joints (n_ball, 4) after the last motion once more.

    Args:
        before_root: T_world_root before the motion, (4, 4).
        before_balls: Unit quaternions of the ball joints before it, (n_ball, 4).
        last_root: T_world_root after it, (4, 4).
        last_balls: Unit quaternions of the ball joints after it, (n_ball, 4).
    """
    balls = np.empty((len(last_balls), 4))
    for n in range(len(balls)):
        a, b, c, d = last_balls[n, 0], last_balls[n, 1], last_balls[n, 2], last_balls[n, 3]
        x, y, z, w = before_balls[n, 0], before_balls[n, 1], before_balls[n, 2], before_balls[n, 3]
        x, y, z, w = hamilton_product(-x, -y, -z, w, a, b, c, d)
        # Without it, the errors of both norms would add up from frame to frame.
        norm = sqrt(x * x + y * y + z * z + w * w)
        norm = -norm if w < 0.0 else norm
        x, y, z, w = hamilton_product(a, b, c, d, x / norm, y / norm, z / norm, w / norm)
        balls[n, 0], balls[n, 1], balls[n, 2], balls[n, 3] = x, y, z, w
    root, step, square = np.empty((4, 4)), np.empty((3, 3)), np.empty((3, 3))
    for i in range(3):
        root[i, 3] = 2.0 * last_root[i, 3] - before_root[i, 3]
        root[3, i] = 0.0
        for j in range(3):
            step[i, j] = 0.0
            for k in range(3):
                step[i, j] += before_root[k, i] * last_root[k, j]
    root[3, 3] = 1.0
    for i in range(3):
        for j in range(3):
            square[i, j] = 1.5 if i == j else 0.0
            for k in range(3):
                square[i, j] -= 0.5 * step[k, i] * step[k, j]
    # One Newton step to the nearest rotation, M (3 I - M^T M) / 2, for the same reason.
    for i in range(3):
        for j in range(3):
            root[i, j] = 0.0
            for k in range(3):
                for m in range(3):
                    root[i, j] += last_root[i, k] * step[k, m] * square[m, j]
    return root, balls
