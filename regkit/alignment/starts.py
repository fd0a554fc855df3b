"""Starts of an alignment: guesses, files, and the plug-ins that search in any orientation."""

from __future__ import annotations

import re
from pathlib import Path

import numpy as np

from regkit.clouds import voxel_downsampled, voxel_for
from regkit.clouds.formats.text.lines import lines_of
from regkit.clouds.tree import Tree
from regkit.config.model import did_you_mean
from regkit.geometry.rigid import checked_rigid, transformed
from regkit.interfaces import AlignmentCandidate, AlignmentStart, Method
from regkit.system.arrays import Array
from regkit.system.errors import ConfigError, DataError
from regkit.system.guard import reading
from regkit.system.plain_numbers import real
from regkit.system.printable import shortened

GUESSES = ("nearest", "identity", "centroids")
"""Names of guesses, which no plug-in computes."""

STARTS = ("auto", *GUESSES)
"""Names of starts beside the plug-ins; any other name is a file."""

LITTLE = 0.02
"""Overlap, less what contradicts it, below which what features found is no better than a guess."""

FEW, UNSURE = 2000, 0.3
"""Clouds of so few points have too few features for an answer of less overlap than this."""

COMPARED_POINTS = 500
"""Approximate number of points by which two initial alignments are compared."""


def candidates_of(
    start: str | AlignmentStart, source: Array, target: Array, method: Method
) -> list[AlignmentCandidate]:
    """Returns the candidates of a start, the best first.

    ``auto`` is the default search, and a guess where it finds hardly any overlap.

    Args:
        start: A plug-in, one of ``STARTS``, the name of a plug-in, or a text file with a 4x4
            matrix T_target_source.
        source: Points to align, (N, 3) [m].
        target: Fixed points, (M, 3) [m].
        method: The registration method, with which ``rotations`` tries rotations.

    Raises:
        RegkitError: If there is no such name or file, or no start is found.
    """
    if isinstance(start, AlignmentStart):
        return start.candidates(source, target, method)
    match start:
        case "auto":
            return _automatic(source, target, method)
        case "nearest":
            return [nearest(source, target)]
        case "identity":
            return [AlignmentCandidate(np.eye(4), np.inf, "identity")]
        case "centroids":
            transform = _centroids(source, target)
            return [AlignmentCandidate(transform, np.inf, "alignment of the centroids")]
    if start in AlignmentStart.available():
        search = AlignmentStart.parse(start, place="start", field="start")
        return search.candidates(source, target, method)
    return [AlignmentCandidate(read_transform(start), np.inf, f"the matrix in {start}")]


def _automatic(source: Array, target: Array, method: Method) -> list[AlignmentCandidate]:
    """Returns what the default search finds; with a guess, if that has hardly any overlap."""
    default = AlignmentStart.parse(AlignmentStart.default(), place="start", field="start")
    try:
        found = default.candidates(source, target, method)
    except DataError:
        return [nearest(source, target)]
    least = UNSURE if min(len(source), len(target)) < FEW else LITTLE
    return found if found[0].overlap >= least else [*found, nearest(source, target)]


def nearest(source: Array, target: Array) -> AlignmentCandidate:
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
        return AlignmentCandidate(
            identity,
            np.inf,
            f"identity (median distance {unmoved:.3g}, {moved:.3g} with aligned centroids)",
        )
    return AlignmentCandidate(
        centroids,
        np.inf,
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
        names = [*STARTS, *AlignmentStart.available()]
        raise ConfigError(
            f"there is no file '{name}'; name one with a 4x4 matrix, or one of {', '.join(names)}"
            + did_you_mean(name, names),
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
