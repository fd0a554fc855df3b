"""Kinematics in compiled loops: on a few dozen joints NumPy's calls cost more than their work.

The formulas are those of ``regkit.rotation`` and of the docstrings where the loops are called.
"""

from __future__ import annotations

from math import atan2, ceil, cos, hypot, pi, sin, sqrt

import numpy as np

from regkit.arrays import Array, Indices
from regkit.optional import compiled


@compiled
def _set_rotation(matrix: Array, x: float, y: float, z: float, w: float) -> None:
    """Writes the rotation matrix of a unit quaternion into (3, 3)."""
    matrix[0, 0] = 1 - 2 * (y * y + z * z)
    matrix[1, 1] = 1 - 2 * (x * x + z * z)
    matrix[2, 2] = 1 - 2 * (x * x + y * y)
    matrix[0, 1], matrix[1, 0] = 2 * (x * y - z * w), 2 * (x * y + z * w)
    matrix[2, 0], matrix[0, 2] = 2 * (x * z - y * w), 2 * (x * z + y * w)
    matrix[1, 2], matrix[2, 1] = 2 * (y * z - x * w), 2 * (y * z + x * w)


@compiled
def _exponential(x: float, y: float, z: float) -> tuple[float, float, float, float]:
    """The unit quaternion of a rotation vector [rad]."""
    square = x * x + y * y + z * z
    half = 0.5 * sqrt(square)
    scale = 0.5 - square / 48.0 if half < 1e-4 else sin(half) / (2.0 * half)
    return scale * x, scale * y, scale * z, cos(half)


@compiled
def _product(
    a: float, b: float, c: float, d: float, x: float, y: float, z: float, w: float
) -> tuple[float, float, float, float]:
    """The Hamilton product (a, b, c, d) (x, y, z, w)."""
    return (
        d * x + w * a + b * z - c * y,
        d * y + w * b + c * x - a * z,
        d * z + w * c + a * y - b * x,
        d * w - a * x - b * y - c * z,
    )


@compiled
def place_links(
    offsets: Array,
    parents: Indices,
    root: Array,
    ball_links: Indices,
    balls: Array,
    hinge_links: Indices,
    hinge_axes: Array,
    hinges: Array,
) -> Array:
    """T_world_link of P poses, (P, L, 4, 4), for balls (P, n_ball, 4) and hinges (P, n_hinge)."""
    poses, count = len(hinges), len(offsets)
    links = np.empty((poses, count, 4, 4))
    turns = np.empty((count, 3, 3))
    turned = np.zeros(count, dtype=np.bool_)
    turned[ball_links] = True
    turned[hinge_links] = True
    local = np.empty((3, 3))
    for pose in range(poses):
        for index in range(len(ball_links)):
            x, y, z, w = balls[pose, index]
            _set_rotation(turns[ball_links[index]], x, y, z, w)
        for index in range(len(hinge_links)):
            angle = hinges[pose, index]
            x, y, z, w = _exponential(
                angle * hinge_axes[index, 0],
                angle * hinge_axes[index, 1],
                angle * hinge_axes[index, 2],
            )
            _set_rotation(turns[hinge_links[index]], x, y, z, w)
        for link in range(count):
            parent = root if parents[link] < 0 else links[pose, parents[link]]
            offset = offsets[link]
            for i in range(3):
                for j in range(3):
                    if turned[link]:
                        local[i, j] = (
                            offset[i, 0] * turns[link, 0, j]
                            + offset[i, 1] * turns[link, 1, j]
                            + offset[i, 2] * turns[link, 2, j]
                        )
                    else:
                        local[i, j] = offset[i, j]
            own = links[pose, link]
            for i in range(3):
                for j in range(3):
                    own[i, j] = (
                        parent[i, 0] * local[0, j]
                        + parent[i, 1] * local[1, j]
                        + parent[i, 2] * local[2, j]
                    )
                own[i, 3] = parent[i, 3] + (
                    parent[i, 0] * offset[0, 3]
                    + parent[i, 1] * offset[1, 3]
                    + parent[i, 2] * offset[2, 3]
                )
                own[3, i] = 0.0
            own[3, 3] = 1.0
    return links


@compiled
def segment_jacobian(twists: Array, moves: Array, arms: Array) -> Array:
    """(S, 6, n) of the freedoms' twists (n, 6), of what they move (n, S), and of arms (S, 3)."""
    freedoms, segments = moves.shape
    jacobian = np.zeros((segments, 6, freedoms))
    for segment in range(segments):
        x, y, z = arms[segment]
        for freedom in range(freedoms):
            if moves[freedom, segment] == 0.0:
                continue
            v0, v1, v2, w0, w1, w2 = twists[freedom]
            jacobian[segment, 0, freedom] = v0 + w1 * z - w2 * y
            jacobian[segment, 1, freedom] = v1 + w2 * x - w0 * z
            jacobian[segment, 2, freedom] = v2 + w0 * y - w1 * x
            jacobian[segment, 3, freedom] = w0
            jacobian[segment, 4, freedom] = w1
            jacobian[segment, 5, freedom] = w2
    return jacobian


@compiled
def joint_twists(
    links: Array,
    reference: Array,
    first: int,
    ball_links: Indices,
    hinge_links: Indices,
    hinge_axes: Array,
    freedoms: int,
    root: Array,
) -> Array:
    """The world twists (n, 6) about a reference of the freedoms at unit rate."""
    twists = np.zeros((freedoms, 6))
    if first == 6:
        for i in range(3):
            twists[i, i] = 1.0
            for j in range(3):
                twists[3 + i, 3 + j] = root[j, i]
    row = first
    axis = np.empty(3)
    for index in range(len(ball_links) + len(hinge_links)):
        ball = index < len(ball_links)
        link = links[ball_links[index]] if ball else links[hinge_links[index - len(ball_links)]]
        x, y, z = link[0, 3] - reference[0], link[1, 3] - reference[1], link[2, 3] - reference[2]
        for part in range(3 if ball else 1):
            for i in range(3):
                if ball:
                    axis[i] = link[i, part]
                else:
                    own = hinge_axes[index - len(ball_links)]
                    axis[i] = link[i, 0] * own[0] + link[i, 1] * own[1] + link[i, 2] * own[2]
            twists[row, 0] = y * axis[2] - z * axis[1]
            twists[row, 1] = z * axis[0] - x * axis[2]
            twists[row, 2] = x * axis[1] - y * axis[0]
            twists[row, 3:] = axis
            row += 1
    return twists


@compiled
def turned_balls(balls: Array, turns: Array) -> Array:
    """Balls (n_ball, 4) after rotation vectors (n_ball, 3) in the frames that they turn."""
    result = np.empty_like(balls)
    for index in range(len(balls)):
        a, b, c, d = balls[index]
        x, y, z, w = _exponential(turns[index, 0], turns[index, 1], turns[index, 2])
        x, y, z, w = _product(a, b, c, d, x, y, z, w)
        result[index, 0], result[index, 1], result[index, 2], result[index, 3] = x, y, z, w
    return result


@compiled
def within_limits(
    balls: Array, centre: Array, twist_axis: Array, cone: Array, twist_limits: Array
) -> tuple[Array, bool]:
    """Balls with swings shortened to their cones and twists clipped; whether any was turned.

    Args:
        balls: (n_ball, 4).
        centre: Middles of the cones, (n_ball, 4).
        twist_axis: (n_ball, 3).
        cone: The two swing axes over the cone's half angles, (n_ball, 2, 3).
        twist_limits: (n_ball, 2).
    """
    result = balls.copy()
    changed = False
    for index in range(len(balls)):
        p, q, r, s = centre[index]
        a, b, c, d = balls[index]
        x, y, z, w = _product(-p, -q, -r, s, a, b, c, d)
        u, v, t = twist_axis[index]
        along = x * u + y * v + z * t
        half = 0.0 if hypot(along, w) < 1e-12 else atan2(along, w)
        twist = 2.0 * half
        twist -= 2.0 * pi * ceil(0.5 * twist / pi - 0.5)
        sine, cosine = sin(half), cos(half)
        x, y, z, w = _product(x, y, z, w, -sine * u, -sine * v, -sine * t, cosine)
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
        x, y, z, w = _exponential(shrink * x, shrink * y, shrink * z)
        a, b, c, d = _exponential(inside * u, inside * v, inside * t)
        a, b, c, d = _product(x, y, z, w, a, b, c, d)
        a, b, c, d = _product(p, q, r, s, a, b, c, d)
        result[index, 0], result[index, 1], result[index, 2], result[index, 3] = a, b, c, d
    return result, changed


@compiled
def ball_steps(starts: Array, ends: Array) -> Array:
    """The rotation vectors (n_ball, 3) [rad], of at most half a turn, from balls to balls."""
    steps = np.empty((len(starts), 3))
    for index in range(len(starts)):
        a, b, c, d = starts[index]
        x, y, z, w = ends[index]
        x, y, z, w = _product(-a, -b, -c, d, x, y, z, w)
        if w < 0.0:
            x, y, z, w = -x, -y, -z, -w
        sine = sqrt(x * x + y * y + z * z)
        scale = 2.0 + sine * sine / 3.0 if sine < 1e-4 else 2.0 * atan2(sine, w) / sine
        steps[index, 0], steps[index, 1], steps[index, 2] = scale * x, scale * y, scale * z
    return steps


@compiled
def step_differential(step: Array, first: int, last: int) -> Array:
    """The identity (n, n) but for the right Jacobians of the rotation vectors step[first:last]."""
    differential = np.eye(len(step))
    for start in range(first, last, 3):
        v = step[start : start + 3]
        square = v[0] ** 2 + v[1] ** 2 + v[2] ** 2
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
                differential[start + i, start + j] = entry
            j, k = (i + 1) % 3, (i + 2) % 3
            # The matrix [v]x has -v_k at (i, j) and v_j at (i, k).
            differential[start + i, start + j] += one * v[k]
            differential[start + i, start + k] -= one * v[j]
    return differential
