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
    balls = np.empty_like(last_balls)
    for index in range(len(balls)):
        a, b, c, d = before_balls[index]
        p, q, r, s = last_balls[index]
        x, y, z, w = hamilton_product(-a, -b, -c, d, p, q, r, s)
        # Without it, the errors of both norms would add up from frame to frame.
        norm = sqrt(x * x + y * y + z * z + w * w)
        norm = -norm if w < 0.0 else norm
        x, y, z, w = hamilton_product(p, q, r, s, x / norm, y / norm, z / norm, w / norm)
        balls[index, 0], balls[index, 1], balls[index, 2], balls[index, 3] = x, y, z, w
    root, step, square = last_root.copy(), np.empty((3, 3)), np.empty((3, 3))
    for i in range(3):
        root[i, 3] += last_root[i, 3] - before_root[i, 3]
        for j in range(3):
            step[i, j] = 0.0
            for k in range(3):
                step[i, j] += before_root[k, i] * last_root[k, j]
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
