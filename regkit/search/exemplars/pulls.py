"""Normal equations of bodies against data and free space, per segment, in compiled loops.

Each residual r of a segment adds w r^2: its Gauss-Newton block is the sum of w a a^T (6, 6), and
its gradient the sum of w r a (6,), where a is the derivative of r to the segment's twist about its
origin, linear first.
"""

from __future__ import annotations

from math import hypot, sqrt

import numpy as np

from regkit.search.exemplars.model import Grid, Hull, Spheres
from regkit.system.arrays import Array
from regkit.system.compiled import compiled

HIDDEN = 0.5
"""Cost of a surface that faces away from the camera, in units of the capsule's radius: the camera
sees the near side only."""


@compiled
def placed_point(T: Array, point: Array) -> tuple[float, float, float]:
    """Returns a point (3,) after a rigid transform (4, 4)."""
    return (
        T[0, 0] * point[0] + T[0, 1] * point[1] + T[0, 2] * point[2] + T[0, 3],
        T[1, 0] * point[0] + T[1, 1] * point[1] + T[1, 2] * point[2] + T[1, 3],
        T[2, 0] * point[0] + T[2, 1] * point[1] + T[2, 2] * point[2] + T[2, 3],
    )


@compiled
def add_pull(
    blocks: Array,
    gradients: Array,
    segment: int,
    arm: Array,
    direction: Array,
    residual: float,
    weight: float,
) -> None:
    """Adds a residual to the blocks (S, 6, 6) and gradients (S, 6).

    Args:
        blocks: Blocks of the segments.
        gradients: Their gradients.
        segment: Segment of the residual.
        arm: Vector from the segment's origin to the point that moves, (3,) [m].
        direction: Derivative of the residual to the point, (3,).
        residual: The residual [m].
        weight: Its weight.
    """
    row = np.empty(6)
    for i in range(3):
        j, k = (i + 1) % 3, (i + 2) % 3
        row[i] = direction[i]
        row[3 + i] = arm[j] * direction[k] - arm[k] * direction[j]
    for i in range(6):
        gradients[segment, i] += weight * residual * row[i]
        for j in range(6):
            blocks[segment, i, j] += weight * row[i] * row[j]


@compiled
def pull_to_data(
    blocks: Array,
    gradients: Array,
    transforms: Array,
    points: Array,
    hull: Hull,
    scale: float,
    one_sided: bool,
) -> None:
    """Adds the distances of points to the surface of capsules, weighed robustly.

    Args:
        blocks: Blocks of the segments, (S, 6, 6).
        gradients: Their gradients, (S, 6).
        transforms: T_camera_segment, (S, 4, 4).
        points: The data in the camera's frame, (M, 3) [m].
        hull: The capsules.
        scale: Distance at which a point has a quarter of its weight [m].
        one_sided: Whether the data show only the side that faces the camera.
    """
    segments, ends, radii = hull
    count = len(segments)
    starts, units = np.empty((count, 3)), np.empty((count, 3))
    lengths, tangents, widening = np.empty(count), np.empty(count), np.empty(count)
    bounds = np.empty(count)
    for capsule in range(count):
        square = 0.0
        for i in range(3):
            starts[capsule, i] = transforms[segments[capsule], i, 3]
            units[capsule, i] = 0.0
            for j in range(3):
                entry = transforms[segments[capsule], i, j]
                starts[capsule, i] += entry * ends[capsule, 0, j]
                units[capsule, i] += entry * (ends[capsule, 1, j] - ends[capsule, 0, j])
            square += units[capsule, i] ** 2
        lengths[capsule] = sqrt(square)
        safe = max(lengths[capsule], 1e-9)
        for i in range(3):
            units[capsule, i] /= safe
        slope = (radii[capsule, 1] - radii[capsule, 0]) / safe
        sine = min(max(-slope, -0.999), 0.999)
        tangents[capsule] = sine / sqrt(1.0 - sine * sine)
        widening[capsule] = slope
        bounds[capsule] = lengths[capsule] + max(radii[capsule, 0], radii[capsule, 1])
    offset, away, direction, arm = np.empty(3), np.empty(3), np.empty(3), np.empty(3)
    for index in range(len(points)):
        ray = 0.0
        for i in range(3):
            ray += points[index, i] ** 2
        ray = sqrt(ray) + 1e-12
        least, nearest, residual = np.inf, 0, 0.0
        for capsule in range(count):
            height, square = 0.0, 0.0
            for i in range(3):
                offset[i] = points[index, i] - starts[capsule, i]
                height += offset[i] * units[capsule, i]
                square += offset[i] * offset[i]
            # The sphere about the start that holds the capsule excludes those that are too far.
            if square > (least + bounds[capsule]) ** 2:
                continue
            side = sqrt(max(square - height * height, 0.0))
            along = min(max(height - side * tangents[capsule], 0.0), lengths[capsule])
            distance = sqrt(side * side + (height - along) ** 2)
            gap = distance - radii[capsule, 0] - widening[capsule] * along
            cost = abs(gap)
            if cost - 1e-12 > least:
                continue
            turned = 0.0
            for i in range(3):
                away[i] = (offset[i] - along * units[capsule, i]) / (distance + 1e-12)
                turned += away[i] * points[index, i] / ray
            if one_sided and turned > 0.0:
                cost += HIDDEN * radii[capsule, 0] * turned
            if cost < least:
                least, nearest, residual = cost, capsule, gap
                for i in range(3):
                    direction[i] = -away[i]
        weight = 1.0 / (1.0 + (residual / scale) ** 2)
        segment = segments[nearest]
        for i in range(3):
            arm[i] = points[index, i] - transforms[segment, i, 3]
        weight = weight * weight / len(points)
        add_pull(blocks, gradients, segment, arm, direction, residual, weight)


@compiled
def pull_from_free_space(
    blocks: Array,
    gradients: Array,
    transforms: Array,
    spheres: Spheres,
    grid: Grid,
    scale: float,
    weight: float,
) -> None:
    """Adds how far spheres on the body's axes are in free space.

    A sphere is in free space beside the data, or in front of them.

    Args:
        blocks: Blocks of the segments, (S, 6, 6).
        gradients: Their gradients, (S, 6).
        transforms: T_camera_segment, (S, 4, 4).
        spheres: The spheres.
        grid: The data.
        scale: Distance at which a sphere has half its weight [m].
        weight: Weight of all spheres together.
    """
    segments, points, radii, optional = spheres
    image, nearest, intrinsics = grid
    fx, fy, cx, cy = intrinsics
    rows, columns = image.shape
    direction, arm = np.empty(3), np.empty(3)
    required = 0
    for sphere in range(len(radii)):
        required += 0 if optional[sphere] else 1
    for sphere in range(len(radii)):
        if optional[sphere]:
            continue
        segment = segments[sphere]
        x, y, z = placed_point(transforms[segment], points[sphere])
        depth = max(z, 0.05)
        column = min(max(int(np.rint(fx * x / depth + cx)), 0), columns - 1)
        row = min(max(int(np.rint(fy * y / depth + cy)), 0), rows - 1)
        seen = image[row, column]
        if seen < 0.0:
            continue
        direction[0], direction[1], direction[2] = 0.0, 0.0, 0.0
        if np.isfinite(seen):
            gap = seen - (z - 0.5 * radii[sphere])
            if gap <= 0.0:
                continue
            direction[2] = -1.0
        else:
            right = x - (nearest[1, row, column] - cx) / fx * depth
            down = y - (nearest[0, row, column] - cy) / fy * depth
            gap = hypot(right, down)
            if gap <= 0.7 * depth / fx:
                continue
            direction[0], direction[1] = right / gap, down / gap
        arm[0] = x - transforms[segment, 0, 3]
        arm[1] = y - transforms[segment, 1, 3]
        arm[2] = z - transforms[segment, 2, 3]
        share = weight / required / (1.0 + gap / scale)
        add_pull(blocks, gradients, segment, arm, direction, gap, share)
