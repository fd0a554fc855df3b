"""Lookup of the exemplars that resemble a cloud, over all rolls and sizes."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from regkit.geometry.rotation import vector_to_matrix
from regkit.search.exemplars.atlas import Atlas
from regkit.search.exemplars.descriptors import cloud_descriptors
from regkit.search.exemplars.pictures import Pictures
from regkit.system.arrays import Array, Indices


@dataclass(frozen=True)
class Matches:
    """Exemplars that resemble the data, K of them.

    Attributes:
        sizes: Index of the size, (K,).
        exemplars: Index of the exemplar, (K,).
        roots: T_world_root, (K, 4, 4).
        distances: Squared distances of the descriptors, (K,).
    """

    sizes: Indices
    exemplars: Indices
    roots: Array
    distances: Array

    def __len__(self) -> int:
        """Number K of matches."""
        return len(self.sizes)


def matches(
    atlas: Atlas, pictures: Pictures, sizes: Sequence[float], rolls: Array, count: int
) -> Matches:
    """Returns the most similar exemplars, at the place where they cover the data.

    Args:
        atlas: The atlas.
        pictures: The data.
        sizes: Sizes of the body [m].
        rolls: Rolls of the body against the exemplar, (R,) [rad].
        count: Number of matches for each picture and size.
    """
    points, norms = pictures.points, (atlas.codes**2).sum(axis=1)
    middle = points.mean(axis=0)
    turns = np.array([vector_to_matrix(np.array([0.0, 0.0, roll])) for roll in rolls])
    parts = []
    for picture in pictures.pictures:
        around = (points - middle) @ picture.rotation.T
        for index, size in enumerate(sizes):
            descriptors, centre = cloud_descriptors(
                around / size, pictures.spread / size, rolls, not pictures.one_sided
            )
            codes = (descriptors - atlas.mean) @ atlas.basis
            distances = (codes**2).sum(axis=1)[:, None] + norms - 2.0 * codes @ atlas.codes.T
            best = np.argpartition(distances.ravel(), min(count, distances.size - 1))[:count]
            roll, exemplar = np.divmod(best, len(atlas))
            place = middle + picture.rotation.T @ centre * size
            rotations = picture.rotation.T @ turns[roll]
            roots = np.tile(np.eye(4), (len(best), 1, 1))
            roots[:, :3, :3] = rotations @ atlas.views[exemplar]
            moved = rotations @ (atlas.centres[exemplar] * size)[:, :, None]
            roots[:, :3, 3] = place - moved[:, :, 0]
            found = distances.ravel()[best]
            parts.append(Matches(np.full(len(best), index), exemplar, roots, found))
    return Matches(
        *(
            np.concatenate([getattr(part, name) for part in parts])
            for name in ("sizes", "exemplars", "roots", "distances")
        )
    )
