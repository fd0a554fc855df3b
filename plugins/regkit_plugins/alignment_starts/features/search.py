"""The search for the motion between two clouds at one resolution."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from regkit.system.arrays import Array, Indices, Singles
from regkit_plugins.alignment_starts.features.compiled_consistency import (
    Sides,
    consistent,
    spread_over,
)
from regkit_plugins.alignment_starts.features.compiled_descriptors import best_matches
from regkit_plugins.alignment_starts.features.compiled_hypotheses import motions
from regkit_plugins.alignment_starts.features.compiled_refinement import refined
from regkit_plugins.alignment_starts.features.compiled_scores import scores
from regkit_plugins.alignment_starts.features.prepared import Prepared

PARTNERS = 3
"""Number of the most similar points with which each point is paired."""

CORRESPONDENCES = 1500
"""Greatest number of correspondences, the most similar ones."""

CLOSEST, STRETCH, BEND = 5.0, 1.5, 0.3
"""Least distance of two consistent correspondences and greatest difference of distances, in voxels,
and greatest difference of cosines."""

EACH, MOTIONS = 6, 1000
"""Greatest number of motions from each correspondence, and of all."""

LEVER = 3.0
"""Lever at which a normal counts like a point, in voxels."""

ROUGH, FINE = 2.0, 1.5
"""Distance within which a point lies on a surface before and after refinement, in voxels."""

WIDE = 3.0
"""Distance of pairs at the begin of refinement, in voxels."""

REFINED = 80
"""Number of distinct motions that are refined."""

APART, DISTINCT = 4.0, 2.0
"""Distance beyond which motions are distinct, before and after the first refinement, in voxels."""


@dataclass(frozen=True)
class Found:
    """A motion that a search found.

    Attributes:
        motion: Motion from the source to the target relative to their origins, (3, 4).
        overlap: Fraction of both clouds that lies on the other.
        against: Fraction of both clouds that contradicts the motion.
    """

    motion: Array
    overlap: float
    against: float

    @property
    def score(self) -> float:
        """Overlap less contradictions."""
        return self.overlap - self.against


def searched(
    source: Prepared, target: Prepared, voxel: float, guesses: Array, most: int
) -> list[Found]:
    """Returns the best motions of two clouds, the best first.

    Args:
        source: The source.
        target: The target.
        voxel: Side of the voxels of both [m].
        guesses: Motions that compete with those of correspondences, (G, 3, 4).
        most: Greatest number of motions.
    """
    sides = _matched(source, target)
    closest, stretch = CLOSEST * voxel, STRETCH * voxel
    pairs, common, graph = consistent(sides, closest, stretch, BEND)
    order = np.argsort(-common, kind="stable")
    chosen = spread_over(pairs, order, len(sides.source), EACH, MOTIONS)
    tried = np.concatenate([motions(sides, pairs[chosen], graph, LEVER * voxel), guesses])
    a, b = source.around, target.around
    some = (*source.judging, *target.judging)
    radius = float(np.sqrt((a.points**2).sum(axis=1).mean()))
    first = scores(tried, a, b, some, ROUGH * voxel)
    best = _distinct(tried, first[:, 0] - first[:, 1], radius, APART * voxel, REFINED)
    # A guess may be far from the solution, where a score tells nothing.
    best = np.union1d(best, np.arange(len(tried) - len(guesses), len(tried)))
    near = np.array([_refined(tried[m], source.judging, target, voxel) for m in best])
    second = scores(near, a, b, some, FINE * voxel)
    best = _distinct(near, second[:, 0] - second[:, 1], radius, DISTINCT * voxel, most)
    ends = [refined(near[m], a.points, a.normals, b, FINE * voxel, 8) for m in best]
    every = (a.points, a.normals, b.points, b.normals)
    last = scores(np.array(ends), a, b, every, FINE * voxel)
    found = [Found(end, *map(float, one)) for end, one in zip(ends, last, strict=True)]
    return sorted(found, key=lambda one: -one.score)


def _matched(source: Prepared, target: Prepared) -> Sides:
    """Returns the most similar points of both clouds, from either side."""
    similar = source.descriptors @ target.descriptors.T
    partners = min(PARTNERS, *similar.shape)
    there, forth = best_matches(similar, partners)
    here, back = best_matches(np.ascontiguousarray(similar.T), partners)
    count, width = similar.shape
    sources = np.concatenate([np.repeat(np.arange(count), partners), here.ravel()])
    targets = np.concatenate([there.ravel(), np.repeat(np.arange(width), partners)])
    # Points of smooth surfaces have many similar ones, so ranks are compared on each side.
    ranks = np.concatenate([_ranks(forth.ravel()), _ranks(back.ravel())])
    pairs, owners, times = np.unique(
        sources * width + targets, return_inverse=True, return_counts=True
    )
    values = np.zeros(len(pairs))
    np.maximum.at(values, owners, ranks)
    # A pair that is found from both sides comes first.
    best = pairs[np.argsort(-(values + times), kind="stable")[:CORRESPONDENCES]]
    i, j = best // width, best % width
    a, b = source.around, target.around
    return Sides(a.points[i], a.normals[i], b.points[j], b.normals[j])


def _ranks(values: Singles) -> Array:
    """Returns the rank of each value, from 0 to 1."""
    ranks = np.empty(len(values))
    ranks[np.argsort(values, kind="stable")] = np.arange(len(values)) / len(values)
    return ranks


def _refined(motion: Array, judging: tuple[Array, Array], target: Prepared, voxel: float) -> Array:
    wide = refined(motion, *judging, target.around, WIDE * voxel, 6)
    return refined(wide, *judging, target.around, FINE * voxel, 4)


def _distinct(tried: Array, values: Array, radius: float, apart: float, most: int) -> Indices:
    """Returns the motions (T, 3, 4) of the greatest values that are distinct from one another.

    Args:
        tried: The motions.
        values: Their values, (T,).
        radius: Root mean square distance of the source's points from the origin [m].
        apart: Distance beyond which motions are distinct [m].
        most: Greatest number.
    """
    # The root mean square distance of a body's points between two motions, to a constant factor.
    places = np.concatenate([tried[:, :, :3] * radius / np.sqrt(3.0), tried[:, :, 3:]], axis=2)
    places = places.reshape(len(tried), 12)
    chosen: list[int] = []
    for m in np.argsort(-values, kind="stable"):
        if chosen:
            squares = ((places[chosen] - places[m]) ** 2).sum(axis=1)
            if squares.min() < apart**2:
                continue
        chosen.append(int(m))
        if len(chosen) == most:
            break
    return np.array(chosen, dtype=np.intp)
