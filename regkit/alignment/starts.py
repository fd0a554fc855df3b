"""Initial alignment of two clouds."""

from __future__ import annotations

import re
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from regkit.alignment.features import by_features
from regkit.clouds import voxel_downsampled, voxel_for
from regkit.clouds.formats.text.lines import lines_of
from regkit.clouds.tree import Tree
from regkit.config.model import did_you_mean
from regkit.geometry.rigid import checked_rigid, transformed
from regkit.interfaces import Method
from regkit.search.rotations import by_rotations
from regkit.system.arrays import Array
from regkit.system.errors import ConfigError, DataError
from regkit.system.guard import reading
from regkit.system.plain_numbers import real
from regkit.system.printable import shortened

STARTS = ("nearest", "identity", "centroids", "rotations", "features")
"""Names of the initial alignments; any other name is a file."""

COMPARED_POINTS = 500
"""Approximate number of points by which two initial alignments are compared."""


@dataclass(frozen=True)
class InitialAlignment:
    """An initial alignment.

    Attributes:
        transform: T_target_source, (4, 4).
        description: How it was found, for the user.
    """

    transform: Array
    description: str


def initial_alignment(start: str, source: Array, target: Array, method: Method) -> InitialAlignment:
    """Computes the initial alignment that ``start`` names.

    Args:
        start: One of ``STARTS``, or a text file with a 4x4 matrix T_target_source.
        source: Points to align, (N, 3) [m].
        target: Fixed points, (M, 3) [m].
        method: The registration method, with which ``rotations`` tries rotations.

    Raises:
        RegkitError: If there is no such name or file, or no initial alignment is found.
    """
    match start:
        case "nearest":
            return nearest(source, target)
        case "identity":
            return InitialAlignment(np.eye(4), "identity")
        case "centroids":
            return InitialAlignment(_centroids(source, target), "alignment of the centroids")
        case "rotations":
            transform, description = by_rotations(source, target, method)
            return InitialAlignment(transform, description)
        case "features":
            return InitialAlignment(
                by_features(source, target), "matched features, by Open3D's RANSAC"
            )
        case _:
            return InitialAlignment(read_transform(start), f"the matrix in {start}")


def nearest(source: Array, target: Array) -> InitialAlignment:
    """Returns the identity or the alignment of the centroids, whichever is closer.

    Args:
        source: Points to align, (N, 3) [m].
        target: Fixed points, (M, 3) [m].
    """
    few, tree = _downsampled(source), Tree.of(_downsampled(target))
    identity, centroids = np.eye(4), _centroids(source, target)
    unmoved, moved = (
        float(np.median(tree.nearest(transformed(transform, few), 1)[0]))
        for transform in (identity, centroids)
    )
    if unmoved <= moved:
        return InitialAlignment(
            identity,
            f"identity (median distance {unmoved:.3g}, {moved:.3g} with aligned centroids)",
        )
    return InitialAlignment(
        centroids,
        f"alignment of the centroids (median distance {moved:.3g}, {unmoved:.3g} without)",
    )


def read_transform(name: str) -> Array:
    """Reads a rigid motion (4, 4) from a text file of 16 numbers.

    Raises:
        ConfigError: If there is no such file.
        DataError: If it does not contain the 4x4 matrix of a rigid motion.
    """
    path = Path(name)
    if not path.is_file():
        raise ConfigError(
            f"there is no file '{name}'; name one with a 4x4 matrix, or one of {', '.join(STARTS)}"
            + did_you_mean(name, list(STARTS)),
            place="start",
        )
    with reading(path, "a 4x4 matrix"):
        lines = lines_of(path)
        rows = [_numbers(line, f"{name}:{number}") for number, line in enumerate(lines, 1)]
        filled = [row for row in rows if row]
        count = sum(map(len, filled))
        if count != 16:
            raise DataError(f"{count} numbers; a 4x4 matrix has 16 numbers")
        if len(filled) not in (1, 4) or len({len(row) for row in filled}) > 1:
            raise DataError("the 16 numbers must stand in four rows of four, or in one")
        return checked_rigid(np.array(filled).reshape(4, 4), place=name)


def _numbers(line: str, place: str) -> list[float]:
    """Returns the numbers of a line, separated by white space, or by commas or semicolons."""
    bare = re.sub(r"(#|//).*", "", line).strip("[]; \t,")
    words = re.split(r"\s*[,;]\s*|\s+", bare) if bare else []
    try:
        return [real(word.strip("[]")) for word in words]
    except ValueError:
        raise DataError(f"not a row of numbers: '{shortened(line.strip())}'", place=place) from None


def _centroids(source: Array, target: Array) -> Array:
    transform = np.eye(4)
    transform[:3, 3] = target.mean(axis=0) - source.mean(axis=0)
    return transform


def _downsampled(points: Array) -> Array:
    voxel = voxel_for(points, COMPARED_POINTS)
    return points if voxel is None else voxel_downsampled(points, voxel)
