"""Lookup of the exemplars that resemble a cloud, over all rolls and sizes."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, fields

import numpy as np

from regkit.geometry.rotation import vector_to_matrix
from regkit.search.exemplars.atlas import Atlas
from regkit.search.exemplars.descriptors import cloud_descriptors
from regkit.search.exemplars.pictures import Picture, Pictures
from regkit.system.arrays import Array, Indices

ROLLS = 24
"""Number of rolls in a full turn."""


def even_rolls(low: float = -np.pi, high: float = np.pi) -> Array:
    """Returns evenly spaced rolls (R,) [rad] from ``low`` to ``high``; a full turn has no end."""
    count = max(1, round(ROLLS * (high - low) / (2.0 * np.pi)))
    if high - low > 2.0 * np.pi - 1e-6:
        return np.linspace(low, high, count, endpoint=False)
    return np.linspace(low, high, count + 1)


@dataclass(frozen=True)
class Matches:
    """Exemplars that resemble the data, K of them.

    Attributes:
        sizes: Index of the size, (K,).
        roots: T_world_root, (K, 4, 4).
        balls: Unit quaternions of the ball joints, (K, n_ball, 4).
        hinges: Hinge angles, (K, n_hinge) [rad].
    """

    sizes: Indices
    roots: Array
    balls: Array
    hinges: Array

    def __len__(self) -> int:
        """Number K of matches."""
        return len(self.sizes)

    @classmethod
    def joined(cls, parts: Sequence[Matches]) -> Matches:
        """Returns all matches of several lookups."""
        names = [field.name for field in fields(cls)]
        return cls(*(np.concatenate([getattr(part, name) for part in parts]) for name in names))


def matches(
    atlas: Atlas, pictures: Pictures, sizes: Sequence[float], rolls: Array, count: int
) -> Matches:
    """Returns the most similar exemplars, at the place where they cover the data.

    Args:
        atlas: The atlas of whole bodies.
        pictures: The data.
        sizes: Sizes of the body [m].
        rolls: Rolls of the body against the exemplar, (R,) [rad].
        count: Number of matches for each picture and size.
    """
    return Matches.joined([
        _similar(atlas, pictures, picture, (index, size), rolls, count)
        for picture in pictures.pictures
        for index, size in enumerate(sizes)
    ])  # fmt: skip


def cut_matches(atlas: Atlas, pictures: Pictures, sizes: Sequence[float], count: int) -> Matches:
    """Returns the most similar exemplars that are cut off at the same borders as the data.

    Args:
        atlas: The atlas of bodies that are cut off below.
        pictures: The data.
        sizes: Sizes of the body [m].
        count: Number of matches for each border and size.
    """
    found = []
    for picture in pictures.pictures:
        for border in picture.borders:
            # The roll of the border of an exemplar, which is below, to this one.
            across, down, _ = picture.rotation @ border
            roll = np.array([np.arctan2(down, across) - 0.5 * np.pi])
            found += [
                _similar(atlas, pictures, picture, (index, size), roll, count)
                for index, size in enumerate(sizes)
            ]
    return Matches.joined(found)


def _similar(
    atlas: Atlas,
    pictures: Pictures,
    picture: Picture,
    sized: tuple[int, float],
    rolls: Array,
    count: int,
) -> Matches:
    """Returns the most similar exemplars of one size, given by index and value, in one picture."""
    index, size = sized
    middle = pictures.points.mean(axis=0)
    around = (pictures.points - middle) @ picture.rotation.T
    descriptors, centre = cloud_descriptors(
        around / size, pictures.spread / size, rolls, not pictures.one_sided
    )
    codes = (descriptors - atlas.mean) @ atlas.basis
    distances = atlas.norms - 2.0 * codes @ atlas.codes.T
    distances += (codes**2).sum(axis=1)[:, None]
    best = np.argpartition(distances.ravel(), min(count, distances.size - 1))[:count]
    roll, exemplar = np.divmod(best, len(atlas))
    place = middle + picture.rotation.T @ centre * size
    turns = np.array([vector_to_matrix(np.array([0.0, 0.0, angle])) for angle in rolls])
    rotations = picture.rotation.T @ turns[roll]
    roots = np.tile(np.eye(4), (len(best), 1, 1))
    roots[:, :3, :3] = rotations @ atlas.views[exemplar]
    moved = rotations @ (atlas.centres[exemplar] * size)[:, :, None]
    roots[:, :3, 3] = place - moved[:, :, 0]
    balls, hinges = atlas.balls[exemplar], atlas.hinges[exemplar]
    return Matches(np.full(len(best), index), roots, balls.astype(float), hinges.astype(float))
