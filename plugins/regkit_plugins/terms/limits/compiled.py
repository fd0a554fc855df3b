"""The limits term, compiled; ``BoundLimits`` and ``Limits.linearized`` are its readable forms."""

from __future__ import annotations

from math import atan2, ceil, cos, hypot, pi, sin, sqrt

import numpy as np

from regkit.interfaces.compiled import PriorArrays
from regkit.skeleton.arrays import PoseArrays, SkeletonArrays
from regkit.skeleton.compiled_rotation import exponential, hamilton_product, set_rotation
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
    """Returns ``1/2 sum w v^2`` over the violations v, and adds its derivatives.

    The weight of ball joints is the number, those of the hinges are in the table, (n_hinge, 1).
    """
    energy, weight, dof = 0.0, numbers[0], skeleton.first
    slope = np.empty(3)
    for ball in range(len(pose.balls)):
        for part in range(2):
            violation = _ball_violation(skeleton, pose.balls, ball, part == 1, slope)
            if violation > 0.0:
                energy += 0.5 * weight * violation**2
                for i in range(3):
                    force[dof + i] += weight * violation * slope[i]
                    for j in range(3):
                        matrix[dof + i, dof + j] += weight * slope[i] * slope[j]
        dof += 3
    for hinge in range(len(pose.hinges)):
        below = skeleton.limits.hinges[hinge, 0] - pose.hinges[hinge]
        above = pose.hinges[hinge] - skeleton.limits.hinges[hinge, 1]
        violation, weight = max(below, above), table[hinge, 0]
        if violation > 0.0:
            energy += 0.5 * weight * violation**2
            force[dof] += weight * (violation if above > below else -violation)
            matrix[dof, dof] += weight
        dof += 1
    return energy


@compiled(python=False)
def _ball_violation(
    skeleton: SkeletonArrays, balls: Matrix, ball: int, swings: bool, slope: Vector
) -> float:
    """Returns the violation of a ball's twist or swing limit [rad], and writes its derivative."""
    limits = skeleton.limits
    p, q, r, s = (
        limits.centres[ball, 0], limits.centres[ball, 1], limits.centres[ball, 2],
        limits.centres[ball, 3],
    )  # fmt: skip
    x, y, z, w = hamilton_product(
        -p, -q, -r, s, balls[ball, 0], balls[ball, 1], balls[ball, 2], balls[ball, 3]
    )
    a, b, c = limits.twist_axes[ball, 0], limits.twist_axes[ball, 1], limits.twist_axes[ball, 2]
    along = x * a + y * b + z * c
    half = 0.0 if hypot(along, w) < 1e-12 else atan2(along, w)
    twist = 2.0 * half - 2.0 * pi * ceil(half / pi - 0.5)
    # dq = q (w, 0) / 2 moves the twist angle 2 atan2(q.a, q_w).
    rest = max(along * along + w * w, 1e-12)
    to_twist = (
        (w * (w * a - (y * c - z * b)) + along * x) / rest,
        (w * (w * b - (z * a - x * c)) + along * y) / rest,
        (w * (w * c - (x * b - y * a)) + along * z) / rest,
    )
    if not swings:
        below, above = limits.twists[ball, 0] - twist, twist - limits.twists[ball, 1]
        sign = 1.0 if above > below else -1.0
        slope[0], slope[1], slope[2] = sign * to_twist[0], sign * to_twist[1], sign * to_twist[2]
        return float(max(below, above))
    sine, cosine = sin(half), cos(half)
    x, y, z, w = hamilton_product(x, y, z, w, -sine * a, -sine * b, -sine * c, cosine)
    if w < 0.0:
        x, y, z, w = -x, -y, -z, -w
    length = sqrt(x * x + y * y + z * z)
    scale = 2.0 + length * length / 3.0 if length < 1e-4 else 2.0 * atan2(length, w) / length
    swing = np.empty(3)
    swing[0], swing[1], swing[2] = scale * x, scale * y, scale * z
    one = two = square = 0.0
    for i in range(3):
        one += limits.cones[ball, 0, i] * swing[i]
        two += limits.cones[ball, 1, i] * swing[i]
        square += swing[i] ** 2
    stretch = hypot(one, two)
    if stretch <= 1.0:
        return 0.0
    angle = sqrt(square)
    # v = |s| - |s| / g(s), with the stretch g.
    rate, turned = np.empty(3), np.empty((3, 3))
    for i in range(3):
        grow = (one * limits.cones[ball, 0, i] + two * limits.cones[ball, 1, i]) / stretch
        rate[i] = swing[i] / angle * (1.0 - 1.0 / stretch) + angle / stretch**2 * grow
    # exp(swing) = q exp(-twist a): rotating q by w rotates the swing by R_twist w - a dtwist.
    x, y, z, w = exponential(twist * a, twist * b, twist * c)
    set_rotation(turned, x, y, z, w)
    for j in range(3):
        turned[0, j] -= a * to_twist[j]
        turned[1, j] -= b * to_twist[j]
        turned[2, j] -= c * to_twist[j]
    # The inverse of the right Jacobian is I + [s]x / 2 + k [s]x^2; its transpose acts on the rate.
    k = 1.0 / square - (1.0 + cos(angle)) / (2.0 * angle * sin(angle))
    inner = rate[0] * swing[0] + rate[1] * swing[1] + rate[2] * swing[2]
    pulled = np.empty(3)
    for i in range(3):
        j, m = (i + 1) % 3, (i + 2) % 3
        crossed = rate[j] * swing[m] - rate[m] * swing[j]
        pulled[i] = rate[i] + 0.5 * crossed + k * (swing[i] * inner - square * rate[i])
    for j in range(3):
        slope[j] = pulled[0] * turned[0, j] + pulled[1] * turned[1, j] + pulled[2] * turned[2, j]
    return angle * (1.0 - 1.0 / stretch)
