"""What tells the outer side of a surface and the direction of a view, in compiled loops."""

from __future__ import annotations

from math import sqrt

import numpy as np

from regkit.system.arrays import Array
from regkit.system.compiled import compiled
from regkit_plugins.alignment_starts.features.compiled_buckets import buckets_of

LAYER = 1.5
"""Distance behind the nearest points of a cell, in cells, beyond which a point is hidden; it grows
with the slope of the surface."""

STEEPEST = 0.15
"""Least cosine between a normal and the view for which the slope still counts."""

RIM = 3
"""Number of cells around a cell of the silhouette with which its height is compared."""


@compiled(reordered=True)
def convexities(points: Array, normals: Array, radius: float) -> Array:
    """Returns how far each point lies outside the mean of those around it, (N,) [m].

    Args:
        points: The points, (N, 3) [m].
        normals: Their normals, (N, 3).
        radius: Radius of a neighbourhood [m].
    """
    buckets = buckets_of(points, radius)
    low, counts = buckets.low, buckets.counts
    outside = np.zeros(len(points))
    for i in range(len(points)):
        a = int((points[i, 0] - low[0]) / radius)
        b = int((points[i, 1] - low[1]) / radius)
        c = int((points[i, 2] - low[2]) / radius)
        total, number = 0.0, 0
        for x in range(max(a - 1, 0), min(a + 2, counts[0])):
            for y in range(max(b - 1, 0), min(b + 2, counts[1])):
                row = (x * counts[1] + y) * counts[2]
                first = buckets.firsts[row + max(c - 1, 0)]
                last = buckets.firsts[row + min(c + 2, counts[2])]
                for place in range(first, last):
                    j = buckets.order[place]
                    u, v = points[i, 0] - points[j, 0], points[i, 1] - points[j, 1]
                    w = points[i, 2] - points[j, 2]
                    if u * u + v * v + w * w < radius * radius:
                        total += u * normals[i, 0] + v * normals[i, 1] + w * normals[i, 2]
                        number += 1
        outside[i] = total / number
    return outside


@compiled
def across(direction: Array) -> tuple[Array, Array]:
    """Returns two unit vectors (3,) at right angles to a unit direction and to each other."""
    other = np.zeros(3)
    other[0 if abs(direction[0]) < 0.6 else 1] = 1.0
    first = np.cross(direction, other)
    first /= sqrt((first * first).sum())
    return first, np.cross(direction, first)


@compiled(reordered=True)
def projected(points: Array, direction: Array, size: float) -> tuple[Array, Array, Array]:
    """Returns columns, rows and heights of points as a camera far away in a direction sees them.

    Args:
        points: The points, (N, 3) [m].
        direction: Unit direction to the camera, (3,).
        size: Side of a pixel [m].
    """
    first, second = across(direction)
    columns, rows = np.zeros(len(points)), np.zeros(len(points))
    heights = np.zeros(len(points))
    for n in range(len(points)):
        for i in range(3):
            columns[n] += points[n, i] * first[i] / size
            rows[n] += points[n, i] * second[i] / size
            heights[n] += points[n, i] * direction[i]
    return np.floor(columns - columns.min()), np.floor(rows - rows.min()), heights


@compiled(reordered=True)
def hidden_shares(points: Array, normals: Array, directions: Array, size: float) -> Array:
    """Returns the fraction of points that others would hide, seen from each of some sides, (D,).

    Args:
        points: The points, (N, 3) [m].
        normals: Their normals of any sign, (N, 3).
        directions: Unit directions to a camera far away, (D, 3).
        size: Side of a pixel [m].
    """
    shares = np.empty(len(directions))
    for d in range(len(directions)):
        direction = directions[d]
        columns, rows, heights = projected(points, direction, size)
        front = np.full((int(columns.max()) + 1, int(rows.max()) + 1), -np.inf)
        for n in range(len(points)):
            column, row = int(columns[n]), int(rows[n])
            front[column, row] = max(front[column, row], heights[n])
        hidden = 0
        for n in range(len(points)):
            cosine = 0.0
            for i in range(3):
                cosine += normals[n, i] * direction[i]
            slope = sqrt(max(1.0 - cosine * cosine, 0.0)) / max(abs(cosine), STEEPEST)
            behind = front[int(columns[n]), int(rows[n])] - heights[n]
            if behind > LAYER * size * (1.0 + slope):
                hidden += 1
        shares[d] = hidden / len(points)
    return shares


@compiled
def rim_height(points: Array, direction: Array, size: float) -> float:
    """Returns how much nearer to the camera the rim of a silhouette is than what is beside it.

    Surfaces recede towards their silhouettes, so that it is negative if the camera is there, and
    positive if it is on the other side. The unit is the pixel.

    Args:
        points: The points, (N, 3) [m].
        direction: Unit direction to the camera, (3,).
        size: Side of a pixel [m].
    """
    columns, rows, heights = projected(points, direction, size)
    width, height = int(columns.max()) + 3, int(rows.max()) + 3
    counts, sums = np.zeros((width, height), np.int64), np.zeros((width, height))
    for n in range(len(points)):
        column, row = int(columns[n]) + 1, int(rows[n]) + 1
        counts[column, row] += 1
        sums[column, row] += heights[n]
    total, number = 0.0, 0
    for x in range(1, width - 1):
        for y in range(1, height - 1):
            beside = min(counts[x - 1, y], counts[x + 1, y], counts[x, y - 1], counts[x, y + 1])
            if counts[x, y] == 0 or beside > 0:
                continue
            mean, cells = 0.0, 0
            for i in range(max(x - RIM, 0), min(x + RIM + 1, width)):
                for j in range(max(y - RIM, 0), min(y + RIM + 1, height)):
                    if counts[i, j] > 0:
                        mean += sums[i, j] / counts[i, j]
                        cells += 1
            nearer = (sums[x, y] / counts[x, y] - mean / cells) / size
            # A rim in front of another part of the surface says little by its distance from it.
            total += min(max(nearer, -float(RIM)), float(RIM))
            number += 1
    return total / max(number, 1)
