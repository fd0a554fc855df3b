"""Histograms that describe the surface around a point, in compiled loops."""

from __future__ import annotations

from math import atan2, pi, sqrt

import numpy as np

from regkit.system.arrays import Array, Indices, Singles
from regkit.system.compiled import compiled

BINS = 11
"""Number of bins of the histogram of each angle, as in Open3D."""

NEAREST = 0.1
"""Least distance by which a neighbour's histogram is weighted, relative to the radius."""


@compiled(reordered=True)
def descriptors(points: Array, normals: Array, pairs: Indices, radius: float) -> Singles:
    """Returns a descriptor of unit length for each point, (N, 3 BINS).

    They are the fast point feature histograms of Rusu, Blodow and Beetz, Fast Point Feature
    Histograms (FPFH) for 3D Registration, 2009, section III, with the square root of each share, so
    that products of descriptors compare distributions (Bhattacharyya).

    Args:
        points: The points, (N, 3) [m].
        normals: Their normals with the sign of the outer side, (N, 3).
        pairs: Pairs of neighbouring points, (P, 2).
        radius: Radius within which they are neighbours [m].
    """
    count = len(points)
    simple = np.zeros((count, 3 * BINS), np.float32)
    weights, numbers = np.zeros(len(pairs), np.float32), np.zeros(count, np.float32)
    for p in range(len(pairs)):
        i, j = pairs[p, 0], pairs[p, 1]
        u, v = points[j, 0] - points[i, 0], points[j, 1] - points[i, 1]
        w = points[j, 2] - points[i, 2]
        distance = sqrt(u * u + v * v + w * w)
        if distance == 0.0:
            continue
        u, v, w = u / distance, v / distance, w / distance
        here = normals[i, 0] * u + normals[i, 1] * v + normals[i, 2] * w
        there = normals[j, 0] * u + normals[j, 1] * v + normals[j, 2] * w
        # The frame is at the point whose normal is closer to the line, so the pair has one order.
        if abs(here) < abs(there):
            own, other, along = j, i, -there
            u, v, w = -u, -v, -w
        else:
            own, other, along = i, j, here
        a, b, c = normals[own, 0], normals[own, 1], normals[own, 2]
        x, y, z = v * c - w * b, w * a - u * c, u * b - v * a
        length = sqrt(x * x + y * y + z * z)
        if length < 1e-9:
            continue
        x, y, z = x / length, y / length, z / length
        d, e, f = normals[other, 0], normals[other, 1], normals[other, 2]
        sine = (b * z - c * y) * d + (c * x - a * z) * e + (a * y - b * x) * f
        angle = atan2(sine, a * d + b * e + c * f) / (2.0 * pi) + 0.5
        first = min(max(int(angle * BINS), 0), BINS - 1)
        second = min(max(int((0.5 * (x * d + y * e + z * f) + 0.5) * BINS), 0), BINS - 1)
        third = min(max(int((0.5 * along + 0.5) * BINS), 0), BINS - 1)
        for end in (i, j):
            simple[end, first] += 1.0
            simple[end, BINS + second] += 1.0
            simple[end, 2 * BINS + third] += 1.0
            numbers[end] += 1.0
        weights[p] = 1.0 / max(distance, NEAREST * radius)
    for n in range(count):
        for k in range(3 * BINS):
            simple[n, k] /= max(numbers[n], np.float32(1.0))
    return _weighted(simple, pairs, weights)


@compiled(reordered=True)
def _weighted(simple: Singles, pairs: Indices, weights: Singles) -> Singles:
    """Returns the means of each point's and its neighbours' histograms, as unit vectors."""
    count, size = simple.shape
    found, totals = np.zeros((count, size), np.float32), np.zeros(count, np.float32)
    for p in range(len(pairs)):
        i, j, weight = pairs[p, 0], pairs[p, 1], weights[p]
        totals[i] += weight
        totals[j] += weight
        for k in range(size):
            found[i, k] += weight * simple[j, k]
            found[j, k] += weight * simple[i, k]
    for n in range(count):
        if totals[n] == 0.0:
            continue
        for k in range(size):
            share = 0.5 * (simple[n, k] + found[n, k] / totals[n])
            found[n, k] = sqrt(share / 3.0)
    return found


@compiled
def best_matches(similarities: Singles, most: int) -> tuple[Indices, Singles]:
    """Returns the most similar columns of each row, (N, most), and their similarities.

    Args:
        similarities: Products of descriptors, (N, M).
        most: Number of columns for each row.
    """
    count, width = similarities.shape
    columns = np.zeros((count, most), np.int64)
    values = np.full((count, most), -np.inf, np.float32)
    for i in range(count):
        for j in range(width):
            value = similarities[i, j]
            if value > values[i, most - 1]:
                k = most - 1
                while k > 0 and values[i, k - 1] < value:
                    values[i, k], columns[i, k] = values[i, k - 1], columns[i, k - 1]
                    k -= 1
                values[i, k], columns[i, k] = value, j
    return columns, values
