"""Pairs of correspondences that one rigid motion can explain, in compiled loops.

The graph of consistent pairs is kept in bits, 64 correspondences in a word, so that common
neighbours are counted word by word.
"""

from __future__ import annotations

from math import sqrt
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from regkit.system.arrays import Array, Indices
from regkit.system.compiled import compiled

Bits = NDArray[np.uint64]


class Sides(NamedTuple):
    """Corresponding points with their normals.

    Attributes:
        source: Points of the source, (N, 3) [m].
        source_normals: Their normals, (N, 3).
        target: The corresponding points of the target, (N, 3) [m].
        target_normals: Their normals, (N, 3).
    """

    source: Array
    source_normals: Array
    target: Array
    target_normals: Array


@compiled
def consistent(
    sides: Sides, closest: float, stretch: float, bend: float
) -> tuple[Indices, Indices, Bits]:
    """Returns consistent pairs (P, 2), their numbers of common neighbours (P,), and the graph.

    A rigid motion leaves the distance of two points alone, and the angles of both normals and of
    the line between them (Drost et al., Model globally, match locally, 2010, eq. 1). The common
    neighbours are those of Chen et al., SC2-PCR, 2022, eq. 7.

    Args:
        sides: The correspondences.
        closest: Least distance of two points [m].
        stretch: Greatest difference of distances [m].
        bend: Greatest difference of cosines.
    """
    count = len(sides.source)
    graph = np.zeros((count, (count + 63) // 64), np.uint64)
    pairs, found = np.empty((16 * count + 16, 2), np.int64), 0
    s, t, m, n = sides.source, sides.target, sides.source_normals, sides.target_normals
    for i in range(count):
        for j in range(i + 1, count):
            a, b, c = s[j, 0] - s[i, 0], s[j, 1] - s[i, 1], s[j, 2] - s[i, 2]
            x, y, z = t[j, 0] - t[i, 0], t[j, 1] - t[i, 1], t[j, 2] - t[i, 2]
            here, there = a * a + b * b + c * c, x * x + y * y + z * z
            if here < closest * closest or there < closest * closest:
                continue
            here, there = sqrt(here), sqrt(there)
            if abs(here - there) > stretch:
                continue
            between = m[i, 0] * m[j, 0] + m[i, 1] * m[j, 1] + m[i, 2] * m[j, 2]
            between -= n[i, 0] * n[j, 0] + n[i, 1] * n[j, 1] + n[i, 2] * n[j, 2]
            if abs(between) > bend:
                continue
            first = (m[i, 0] * a + m[i, 1] * b + m[i, 2] * c) / here
            first -= (n[i, 0] * x + n[i, 1] * y + n[i, 2] * z) / there
            second = (m[j, 0] * a + m[j, 1] * b + m[j, 2] * c) / here
            second -= (n[j, 0] * x + n[j, 1] * y + n[j, 2] * z) / there
            if abs(first) > bend or abs(second) > bend:
                continue
            graph[i, j >> 6] |= np.uint64(1) << np.uint64(j & 63)
            graph[j, i >> 6] |= np.uint64(1) << np.uint64(i & 63)
            if found == len(pairs):
                more = np.empty((2 * found, 2), np.int64)
                for p in range(found):
                    more[p, 0], more[p, 1] = pairs[p, 0], pairs[p, 1]
                pairs = more
            pairs[found, 0], pairs[found, 1] = i, j
            found += 1
    common = np.zeros(found, np.int64)
    for p in range(found):
        for word in range(graph.shape[1]):
            common[p] += _ones(graph[pairs[p, 0], word] & graph[pairs[p, 1], word])
    return pairs[:found], common, graph


@compiled
def _ones(word: np.uint64) -> np.int64:
    """Returns the number of bits that are set (Warren, Hacker's Delight, 2012, section 5-1)."""
    word = word - ((word >> np.uint64(1)) & np.uint64(0x5555555555555555))
    pairs = np.uint64(0x3333333333333333)
    word = (word & pairs) + ((word >> np.uint64(2)) & pairs)
    word = (word + (word >> np.uint64(4))) & np.uint64(0x0F0F0F0F0F0F0F0F)
    return np.int64((word * np.uint64(0x0101010101010101)) >> np.uint64(56))


@compiled
def spread_over(pairs: Indices, order: Indices, count: int, each: int, most: int) -> Indices:
    """Returns the first pairs of an order in which no correspondence is too often, (S,).

    Args:
        pairs: Pairs of correspondences, (P, 2).
        order: Their order, (P,).
        count: Number of correspondences.
        each: Greatest number of pairs for each of them.
        most: Greatest number of pairs.
    """
    taken, chosen, found = np.zeros(count, np.int64), np.empty(most, np.int64), 0
    for p in order:
        i, j = pairs[p, 0], pairs[p, 1]
        if taken[i] < each and taken[j] < each:
            taken[i] += 1
            taken[j] += 1
            chosen[found] = p
            found += 1
            if found == most:
                break
    return chosen[:found]
