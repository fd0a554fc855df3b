"""Retraction, differences and limits of poses in compiled loops."""

from __future__ import annotations

from math import atan2, ceil, cos, hypot, pi, sin, sqrt

import numpy as np

from regkit.skeleton.compiled_rotation import exponential, hamilton_product, set_rotation
from regkit.system.arrays import Array
from regkit.system.compiled import compiled


@compiled
def retracted_root(root: Array, step: Array) -> Array:
    """Returns T_world_root (4, 4) after a step (>= 6,) on the tangent space.

    The step begins with a translation in the world [m] and a rotation vector in the root frame
    [rad].
    """
    rotation = np.empty((3, 3))
    x, y, z, w = exponential(step[3], step[4], step[5])
    set_rotation(rotation, x, y, z, w)
    retracted = np.zeros((4, 4))
    for i in range(3):
        retracted[i, 3] = root[i, 3] + step[i]
        for j in range(3):
            for k in range(3):
                retracted[i, j] += root[i, k] * rotation[k, j]
    retracted[3, 3] = 1.0
    return retracted


@compiled
def retracted_balls(balls: Array, turns: Array) -> Array:
    """Returns quaternions ``balls * exp(turns)`` (n_ball, 4) for rotation vectors (n_ball, 3)."""
    result = np.empty_like(balls)
    for index in range(len(balls)):
        a, b, c, d = balls[index]
        x, y, z, w = exponential(turns[index, 0], turns[index, 1], turns[index, 2])
        x, y, z, w = hamilton_product(a, b, c, d, x, y, z, w)
        result[index, 0], result[index, 1], result[index, 2], result[index, 3] = x, y, z, w
    return result


@compiled
def ball_steps(starts: Array, ends: Array) -> Array:
    """Returns the rotation vectors (n_ball, 3) [rad] with ``starts * exp(steps) = ends``.

    Both arguments are unit quaternions (n_ball, 4); a rotation angle is at most pi.
    """
    steps = np.empty((len(starts), 3))
    for index in range(len(starts)):
        a, b, c, d = starts[index]
        x, y, z, w = ends[index]
        x, y, z, w = hamilton_product(-a, -b, -c, d, x, y, z, w)
        if w < 0.0:
            x, y, z, w = -x, -y, -z, -w
        sine = sqrt(x * x + y * y + z * z)
        scale = 2.0 + sine * sine / 3.0 if sine < 1e-4 else 2.0 * atan2(sine, w) / sine
        steps[index, 0], steps[index, 1], steps[index, 2] = scale * x, scale * y, scale * z
    return steps


@compiled
def step_jacobian(step: Array, first: int, last: int) -> Array:
    """Returns the identity (n, n) with right Jacobians of SO(3) as diagonal blocks.

    Args:
        step: A step on the tangent space, (n,).
        first: Index in ``step`` of the first rotation vector [rad].
        last: Index after the last rotation vector.
    """
    jacobian, v = np.zeros((len(step), len(step))), np.empty(3)
    for dof in range(len(step)):
        jacobian[dof, dof] = 1.0
    for start in range(first, last, 3):
        square = 0.0
        for i in range(3):
            v[i] = step[start + i]
            square += v[i] * v[i]
        angle = sqrt(square)
        if angle < 1e-4:
            one, two = 0.5 - square / 24.0, 1.0 / 6.0 - square / 120.0
        else:
            one, two = (1.0 - cos(angle)) / square, (angle - sin(angle)) / (square * angle)
        for i in range(3):
            for j in range(3):
                entry = two * v[i] * v[j]
                if i == j:
                    entry += 1.0 - two * square
                jacobian[start + i, start + j] = entry
            j, k = (i + 1) % 3, (i + 2) % 3
            # The matrix [v]x has -v_k at (i, j) and v_j at (i, k).
            jacobian[start + i, start + j] += one * v[k]
            jacobian[start + i, start + k] -= one * v[j]
    return jacobian


@compiled
def within_limits(
    balls: Array, centre: Array, twist_axis: Array, cone: Array, twist_limits: Array
) -> tuple[Array, bool]:
    """Projects ball joints onto their limits: swings onto their cones, twists onto intervals.

    Args:
        balls: Unit quaternions, (n_ball, 4).
        centre: Centres of the swing cones as unit quaternions, (n_ball, 4).
        twist_axis: Unit vectors, (n_ball, 3).
        cone: Swing axes divided by the half angles of the cone, (n_ball, 2, 3) [1/rad].
        twist_limits: Lower and upper twist, (n_ball, 2) [rad].

    Returns:
        The projected quaternions (n_ball, 4), and whether any of them changed.
    """
    result = balls.copy()
    changed = False
    for index in range(len(balls)):
        p, q, r, s = centre[index]
        a, b, c, d = balls[index]
        x, y, z, w = hamilton_product(-p, -q, -r, s, a, b, c, d)
        u, v, t = twist_axis[index]
        along = x * u + y * v + z * t
        half = 0.0 if hypot(along, w) < 1e-12 else atan2(along, w)
        twist = 2.0 * half
        twist -= 2.0 * pi * ceil(0.5 * twist / pi - 0.5)
        sine, cosine = sin(half), cos(half)
        x, y, z, w = hamilton_product(x, y, z, w, -sine * u, -sine * v, -sine * t, cosine)
        if w < 0.0:
            x, y, z, w = -x, -y, -z, -w
        length = sqrt(x * x + y * y + z * z)
        scale = 2.0 + length * length / 3.0 if length < 1e-4 else 2.0 * atan2(length, w) / length
        x, y, z = scale * x, scale * y, scale * z
        one, two = cone[index]
        stretch = hypot(one[0] * x + one[1] * y + one[2] * z, two[0] * x + two[1] * y + two[2] * z)
        inside = min(max(twist, twist_limits[index, 0]), twist_limits[index, 1])
        if stretch <= 1.0 and inside == twist:
            continue
        changed = True
        shrink = 1.0 / max(stretch, 1.0)
        x, y, z, w = exponential(shrink * x, shrink * y, shrink * z)
        a, b, c, d = exponential(inside * u, inside * v, inside * t)
        a, b, c, d = hamilton_product(x, y, z, w, a, b, c, d)
        a, b, c, d = hamilton_product(p, q, r, s, a, b, c, d)
        result[index, 0], result[index, 1], result[index, 2], result[index, 3] = a, b, c, d
    return result, changed
