"""Residuals of the points of one capsule, and their derivatives, in single precision.

``residuals_and_rows`` is the readable form. Points and capsules are as in ``compiled_owners``. The
loops have no branches, so that the compiler turns them into vector instructions.
"""

from __future__ import annotations

import numpy as np

from regkit.system.compiled import compiled
from regkit.system.machine_types import Matrix, SingleMatrix, SingleVector, Vector

_ZERO, _ONE, _TINY = np.float32(0.0), np.float32(1.0), np.float32(1e-30)
"""The last divides in place of a length of zero, whose vector is zero too."""


@compiled(reordered=True, python=False)
def write_residuals(
    points: SingleMatrix,
    capsule: SingleVector,
    eye: SingleVector,
    first: int,
    last: int,
    residuals: SingleVector,
) -> None:
    """Writes the residuals of a range of points, (N,) [m].

    Args:
        points: Coordinates of the points, (3, N) [m].
        capsule: The capsule, (10,).
        eye: Position of the camera, (3,) [m], and 1 if there is one or 0 if there is none.
        first: First point of the capsule.
        last: The point after its last one.
        residuals: Written from ``first`` on.
    """
    xs, ys, zs = points[0, first:last], points[1, first:last], points[2, first:last]
    cx, cy, cz = capsule[0], capsule[1], capsule[2]
    ux, uy, uz = capsule[3], capsule[4], capsule[5]
    half, radius, sine, tangent = capsule[6], capsule[7], capsule[8], capsule[9]
    ox, oy, oz, seen = eye[0], eye[1], eye[2], eye[3]
    own = residuals[first:last]
    for j in range(len(own)):
        x, y, z = xs[j] - cx, ys[j] - cy, zs[j] - cz
        along = x * ux + y * uy + z * uz
        x, y, z = x - along * ux, y - along * uy, z - along * uz
        at = min(max(along - np.sqrt(x * x + y * y + z * z) * tangent, -half), half)
        rest, radius_there = along - at, radius - sine * at
        x, y, z = x + rest * ux, y + rest * uy, z + rest * uz
        ex, ey, ez = xs[j] - ox, ys[j] - oy, zs[j] - oz
        sight = seen / np.sqrt(max(ex * ex + ey * ey + ez * ez, _TINY))
        behind = (x * ex + y * ey + z * ez) * sight
        shift = behind * sight
        ax, ay, az = x - shift * ex, y - shift * ey, z - shift * ez
        beside = np.sqrt(ax * ax + ay * ay + az * az) - radius_there
        distance = np.sqrt(x * x + y * y + z * z) - radius_there
        outline = np.sqrt(behind * behind + beside * beside)
        own[j] = outline if behind > _ZERO else distance


@compiled(reordered=True, python=False)
def add_derivatives(
    points: SingleMatrix,
    capsule: SingleVector,
    eye: SingleVector,
    first: int,
    last: int,
    residuals: SingleVector,
    factors: SingleVector,
    wrench: Vector,
    block: Matrix,
) -> None:
    """Adds w J^T r (6,) and w J^T J (6, 6) of a range of points.

    Args:
        points: Coordinates of the points, (3, N) [m].
        capsule: The capsule, (10,).
        eye: Position of the camera, (3,) [m], and 1 if there is one or 0 if there is none.
        first: First point of the capsule.
        last: The point after its last one.
        residuals: Residuals of all points, (N,) [m].
        factors: Weights of all points, (N,).
        wrench: Added to.
        block: Added to.
    """
    xs, ys, zs = points[0, first:last], points[1, first:last], points[2, first:last]
    cx, cy, cz = capsule[0], capsule[1], capsule[2]
    ux, uy, uz = capsule[3], capsule[4], capsule[5]
    half, radius, sine, tangent = capsule[6], capsule[7], capsule[8], capsule[9]
    ox, oy, oz, seen = eye[0], eye[1], eye[2], eye[3]
    own, shares = residuals[first:last], factors[first:last]
    f0 = f1 = f2 = f3 = f4 = f5 = _ZERO
    b00 = b01 = b02 = b03 = b04 = b05 = b11 = b12 = b13 = b14 = b15 = _ZERO
    b22 = b23 = b24 = b25 = b33 = b34 = b35 = b44 = b45 = b55 = _ZERO
    for j in range(len(own)):
        dx, dy, dz = xs[j] - cx, ys[j] - cy, zs[j] - cz
        along = dx * ux + dy * uy + dz * uz
        # Across the axis (v), from the nearest sphere's centre (g), along the viewing ray (e).
        vx, vy, vz = dx - along * ux, dy - along * uy, dz - along * uz
        side = np.sqrt(vx * vx + vy * vy + vz * vz)
        free = along - side * tangent
        at = min(max(free, -half), half)
        rest, radius_there = along - at, radius - sine * at
        gx, gy, gz = vx + rest * ux, vy + rest * uy, vz + rest * uz
        ex, ey, ez = xs[j] - ox, ys[j] - oy, zs[j] - oz
        sight = seen / np.sqrt(max(ex * ex + ey * ey + ez * ez, _TINY))
        ex, ey, ez = ex * sight, ey * sight, ez * sight
        behind = gx * ex + gy * ey + gz * ez
        # Across the ray (n). The outline's slope (s) has a part along the ray and one across it.
        nx, ny, nz = gx - behind * ex, gy - behind * ey, gz - behind * ez
        lateral = np.sqrt(nx * nx + ny * ny + nz * nz)
        inverse = _ONE / max(lateral, _TINY)
        nx, ny, nz = nx * inverse, ny * inverse, nz * inverse
        inverse = _ONE / max(abs(own[j]), _TINY)
        deep, wide = behind * inverse, (lateral - radius_there) * inverse
        sx, sy, sz = deep * ex + wide * nx, deep * ey + wide * ny, deep * ez + wide * nz
        # The nearest sphere moves along the axis with the point.
        change = wide * sine - (sx * ux + sy * uy + sz * uz)
        change = change if abs(free) < half else _ZERO
        tilt = change * tangent / max(side, _TINY)
        sx += change * ux - tilt * vx
        sy += change * uy - tilt * vy
        sz += change * uz - tilt * vz
        turning = deep * radius_there
        hidden = behind > _ZERO
        inverse = _ONE / max(np.sqrt(gx * gx + gy * gy + gz * gz), _TINY)
        sx = sx if hidden else gx * inverse
        sy = sy if hidden else gy * inverse
        sz = sz if hidden else gz * inverse
        turning = turning if hidden else _ZERO
        tx = sy * dz - sz * dy + turning * (ny * ez - nz * ey)
        ty = sz * dx - sx * dz + turning * (nz * ex - nx * ez)
        tz = sx * dy - sy * dx + turning * (nx * ey - ny * ex)
        share = shares[j]
        wx, wy, wz = share * sx, share * sy, share * sz
        px, py, pz = share * tx, share * ty, share * tz
        f0 -= wx * own[j]
        f1 -= wy * own[j]
        f2 -= wz * own[j]
        f3 += px * own[j]
        f4 += py * own[j]
        f5 += pz * own[j]
        b00 += wx * sx
        b01 += wx * sy
        b02 += wx * sz
        b11 += wy * sy
        b12 += wy * sz
        b22 += wz * sz
        b03 -= wx * tx
        b04 -= wx * ty
        b05 -= wx * tz
        b13 -= wy * tx
        b14 -= wy * ty
        b15 -= wy * tz
        b23 -= wz * tx
        b24 -= wz * ty
        b25 -= wz * tz
        b33 += px * tx
        b34 += px * ty
        b35 += px * tz
        b44 += py * ty
        b45 += py * tz
        b55 += pz * tz
    wrench[0] += f0
    wrench[1] += f1
    wrench[2] += f2
    wrench[3] += f3
    wrench[4] += f4
    wrench[5] += f5
    entries = (
        (b00, b01, b02, b03, b04, b05),
        (b01, b11, b12, b13, b14, b15),
        (b02, b12, b22, b23, b24, b25),
        (b03, b13, b23, b33, b34, b35),
        (b04, b14, b24, b34, b44, b45),
        (b05, b15, b25, b35, b45, b55),
    )
    for i in range(6):
        for j in range(6):
            block[i, j] += entries[i][j]
