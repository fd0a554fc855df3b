"""Divisions of a cloud among several bodies: by its pieces, and by cuts where the bodies touch."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from itertools import product

import numpy as np
import scipy
from numpy.typing import NDArray

from regkit.clouds import spacing
from regkit.system.arrays import Array, Indices

APART = 2.5
"""Points nearer than this are connected, in units of the cloud's spacing."""

LEAST = 0.15
"""A piece with a smaller part of a body's even share of the points is no body."""

MORE = 2
"""Number of pieces beyond that of the bodies that are looked at."""

SOME = 1200
"""So many points show how a piece is to be cut as well as all of them."""


@dataclass(frozen=True)
class Division:
    """Parts of a cloud, each of which may be one of several bodies.

    Attributes:
        parts: Masks of the points, (N,) each.
        cut: Whether a connected piece is cut, or several are one part.
    """

    parts: tuple[NDArray[np.bool_], ...]
    cut: bool


def divisions(points: Array, count: int) -> Iterator[Division]:
    """Yields divisions of points (N, 3) [m] for several bodies, the likeliest first.

    The first is that into connected pieces, if there are enough; it may have more pieces than there
    are bodies. In the second, all but the largest are one body, which another one hides in part, so
    that it is in pieces. In the others pieces are cut, where their points are least connected (Shi
    and Malik, Normalized cuts and image segmentation, 2000), or in equal parts around centres.

    Args:
        points: The points.
        count: Number of bodies.
    """
    pieces = _pieces(points, count)
    if len(pieces) >= count:
        yield Division(tuple(_mask(one, len(points)) for one in pieces), cut=False)
    rest = _rest(pieces[: count - 1], len(points))
    if rest.any() and len(pieces) >= count - 1:
        large = tuple(_mask(one, len(points)) for one in pieces[: count - 1])
        yield Division((*large, rest), cut=True)
    for cut in (_least_connected, _around_centres):
        for parts in _parts_of(pieces, count):
            made = [
                piece[label == one]
                for piece, number in zip(pieces, parts, strict=True)
                if number
                for label in [cut(points[piece], number)]
                for one in range(number)
            ]
            if all(len(one) for one in made):
                yield Division(tuple(_mask(one, len(points)) for one in made), cut=True)


def _pieces(points: Array, count: int) -> list[Indices]:
    """Returns the indices of the points of each connected piece, the largest first."""
    labels = scipy.sparse.csgraph.connected_components(_bonds(points), directed=False)[1]
    found = [np.flatnonzero(labels == label) for label in range(labels.max() + 1)]
    least = LEAST * len(points) / count
    large = [one for one in found if len(one) >= least]
    return sorted(large, key=len, reverse=True)[: count + MORE]


def _rest(pieces: list[Indices], count: int) -> NDArray[np.bool_]:
    """Returns a mask of the points, (N,), that are in none of some pieces."""
    rest = np.ones(count, dtype=bool)
    for piece in pieces:
        rest[piece] = False
    return rest


def _parts_of(pieces: list[Indices], count: int) -> list[tuple[int, ...]]:
    """Returns into how many parts each piece is cut so that there are ``count``, likeliest first.

    Parts of like size are likelier. A piece without a part is no body.
    """
    every = [
        parts
        for parts in product(range(count + 1), repeat=len(pieces))
        if sum(parts) == count and max(parts, default=0) > 1
    ]

    def largest(parts: tuple[int, ...]) -> float:
        """Returns the size of the largest part, whether it is a body's or none's."""
        return max(len(piece) / max(number, 1) for piece, number in zip(pieces, parts, strict=True))

    return sorted(every, key=largest)[: max(count - 1, 1)]


def _bonds(points: Array, scale: float | None = None) -> scipy.sparse.coo_array:
    """Returns the weights of the bonds of neighbours, (N, N): 1, or less with their distance."""
    near = APART * spacing(points)
    pairs = scipy.spatial.KDTree(points).query_pairs(near, output_type="ndarray")
    weights = np.ones(len(pairs))
    if scale is not None:
        apart = np.linalg.norm(points[pairs[:, 0]] - points[pairs[:, 1]], axis=1)
        weights = np.exp(-0.5 * (apart / (scale * near)) ** 2)
    return scipy.sparse.coo_array((weights, pairs.T), 2 * (len(points),))


def _least_connected(points: Array, count: int) -> Indices:
    """Returns the part of each point, (N,), of a cut through the fewest neighbours."""
    if count == 1:
        return np.zeros(len(points), dtype=np.intp)
    some = points[:: -(-len(points) // SOME)]
    bonds = _bonds(some, 0.5).toarray()
    bonds += bonds.T
    scale = 1.0 / np.sqrt(np.maximum(bonds.sum(axis=0), 1e-9))
    similar = scale[:, None] * bonds * scale
    last = len(some) - 1
    vectors = scipy.linalg.eigh(similar, subset_by_index=(last - count + 1, last))[1]
    labels = _clustered(scale[:, None] * vectors, count)
    return np.asarray(labels[scipy.spatial.KDTree(some).query(points)[1]])


def _around_centres(points: Array, count: int) -> Indices:
    """Returns the part of each point, (N,), around centres of equally many points."""
    return _clustered(points, count)


def _clustered(vectors: Array, count: int) -> Indices:
    """Returns the cluster of each vector, (N,), by k-means from centres far apart."""
    if count == 1:
        return np.zeros(len(vectors), dtype=np.intp)
    vectors = (vectors - vectors.mean(axis=0)) / max(vectors.std(), 1e-12)
    centres = [vectors[int((vectors**2).sum(axis=1).argmax())]]
    while len(centres) < count:
        gaps = np.linalg.norm(vectors[:, None] - np.array(centres), axis=2).min(axis=1)
        centres.append(vectors[int(gaps.argmax())])
    return np.asarray(
        scipy.cluster.vq.kmeans2(vectors, np.array(centres), minit="matrix", missing="warn")[1]
    )


def _mask(indices: Indices, count: int) -> NDArray[np.bool_]:
    mask = np.zeros(count, dtype=bool)
    mask[indices] = True
    return mask
