"""Where an alignment sets out from."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path

import numpy as np

from regkit.alignment.features import by_features
from regkit.clouds import voxel_downsampled, voxel_for
from regkit.config.model import did_you_mean
from regkit.geometry.rigid import transformed
from regkit.interfaces import Method
from regkit.search.rotations import by_rotations
from regkit.system.arrays import Array
from regkit.system.errors import ConfigError, DataError

STARTS = ("nearest", "identity", "centroids", "rotations", "features")
"""The names of the ways to begin; anything else is a file."""

SKETCH = 500
"""So many points tell which of two starts is nearer."""


@dataclass(frozen=True)
class Beginning:
    """Where an alignment sets out from.

    Attributes:
        transform: T_target_source, (4, 4).
        told: How it was found, for the user.
    """

    transform: Array
    told: str


def beginning(start: str, source: Array, target: Array, method: Method) -> Beginning:
    """The start that a user names.

    Args:
        start: One of ``STARTS``, or a file with a 4x4 matrix T_target_source.
        source: Points (N, 3) to be moved.
        target: Points (M, 3) that rest.
        method: What aligns them; rotations are tried with it.

    Raises:
        RegkitError: If there is no such way or file, or it finds nothing.
    """
    match start:
        case "nearest":
            return nearest(source, target)
        case "identity":
            return Beginning(np.eye(4), "identity, as asked for")
        case "centroids":
            return Beginning(_centroids(source, target), "the clouds' centroids on one another")
        case "rotations":
            transform, told = by_rotations(source, target, method)
            return Beginning(transform, told)
        case "features":
            return Beginning(by_features(source, target), "matched features, by Open3D's RANSAC")
        case _:
            return Beginning(read_transform(start), f"the matrix in {start}")


def nearest(source: Array, target: Array) -> Beginning:
    """As the files are, or the centroids on one another, whichever brings the clouds nearer."""
    from scipy.spatial import KDTree

    few, tree = _sketch(source), KDTree(_sketch(target))
    gaps = [
        float(np.median(tree.query(transformed(transform, few))[0]))
        for transform in (np.eye(4), _centroids(source, target))
    ]
    told = "half of the source is within {:.3g} m of the target, {:.3g} m {} are"
    if gaps[0] <= gaps[1]:
        told = told.format(*gaps, "when the centroids")
        return Beginning(np.eye(4), f"as the files are: {told} on one another")
    told = told.format(*reversed(gaps), "as the files")
    return Beginning(_centroids(source, target), f"the centroids on one another: {told}")


def read_transform(name: str) -> Array:
    """The rigid motion (4, 4) in a text file.

    Raises:
        ConfigError: If there is no such file.
        DataError: If it holds no 4x4 matrix of a rigid motion.
    """
    path = Path(name)
    if not path.is_file():
        raise ConfigError(
            f"there is no file '{name}'; name one with a 4x4 matrix, or one of {', '.join(STARTS)}"
            + did_you_mean(name, list(STARTS)),
            place="start",
        )
    try:
        text = path.read_text(encoding="utf-8").replace(",", " ")
        matrix = np.array([float(number) for number in text.split()])
    except ValueError as error:
        raise DataError(f"not a matrix of numbers: {error}", place=name) from None
    if matrix.size != 16:
        raise DataError(f"{matrix.size} numbers; a 4x4 matrix has 16", place=name)
    matrix = matrix.reshape(4, 4)
    rotation = matrix[:3, :3]
    straight = np.abs(rotation.T @ rotation - np.eye(3)).max() < 1e-3
    if not (straight and np.linalg.det(rotation) > 0.0 and np.allclose(matrix[3], [0, 0, 0, 1])):
        raise DataError(
            "the matrix is no rigid motion: its first three rows and columns must be a rotation, "
            "its last row 0 0 0 1",
            place=name,
        )
    left, _, right = np.linalg.svd(rotation)
    matrix[:3, :3] = left @ right
    return matrix


def _centroids(source: Array, target: Array) -> Array:
    transform = np.eye(4)
    transform[:3, 3] = target.mean(axis=0) - source.mean(axis=0)
    return transform


def _sketch(points: Array) -> Array:
    voxel = voxel_for(points, SKETCH)
    return points if voxel is None else voxel_downsampled(points, voxel)
