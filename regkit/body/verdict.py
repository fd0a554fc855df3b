"""Verdicts of frames: whether the body was found, judged by the data alone."""

from __future__ import annotations

from collections.abc import Iterable
from enum import StrEnum
from typing import Any

import numpy as np
from numpy.typing import NDArray

from regkit.system.arrays import Array
from regkit.system.errors import DataError

SURE_INLIERS, SURE_COVERAGE = 0.8, 0.8
"""A frame with smaller shares of inliers or of covered body is doubtful.

These bounds and ``LOST_SHARE`` were chosen on six recordings of UTD-MHAD, the shipped walk and
hand, and made-up walls, boxes and columns; no other data have confirmed them.
"""

SURE_MISFIT = 0.6
"""A frame with a larger misfit is doubtful.

Right starts of people have less in 97 %, both on the development set of ``benchmarks/starts.py``
and on 70 frames of UTD-MHAD; those more than 25 cm off have more in 80 % on the former.
"""

LOST_SHARE = 0.5
"""The body is lost in a frame if either share is smaller."""

FLAT = 0.25
"""Data with less relief are a wall and no body, whose relief is at least 0.77 in 14 recordings of
two people with a depth camera."""


class Verdict(StrEnum):
    """Whether the body was found."""

    FOUND = "found"
    DOUBTFUL = "doubtful"
    LOST = "lost"
    NO_DATA = "no data"


def frame_verdict(
    points: float, inlier_share: float, coverage: float, misfit: float, relief: float
) -> Verdict:
    """Returns the verdict of a frame.

    The body is found where the data lie on its surface and where it has data: either alone accepts
    a body of the wrong size, or in the wrong place. Flat data are no body. Unknown numbers, those
    of a body without a surface, raise no doubt.

    Args:
        points: Number of points of the frame.
        inlier_share: Fraction of the points that lie on the body's surface.
        coverage: Fraction of the visible body that has data nearby.
        misfit: Mean distance of both sides, in limb radii.
        relief: Deviation of the points along their thinnest direction, in limb radii.
    """
    if points == 0:
        return Verdict.NO_DATA
    if inlier_share < LOST_SHARE or coverage < LOST_SHARE or relief < FLAT:
        return Verdict.LOST
    if inlier_share < SURE_INLIERS or coverage < SURE_COVERAGE or misfit > SURE_MISFIT:
        return Verdict.DOUBTFUL
    return Verdict.FOUND


def frame_verdicts(
    points: Array, inlier_shares: Array, coverages: Array, misfits: Array, reliefs: Array
) -> tuple[Verdict, ...]:
    """Returns the verdict of each of T frames, from arrays (T,) of what ``frame_verdict`` takes."""
    columns = (points, inlier_shares, coverages, misfits, reliefs)
    return tuple(map(frame_verdict, *(column.tolist() for column in columns)))


_FROM_GOOD_TO_BAD = (Verdict.NO_DATA, Verdict.FOUND, Verdict.DOUBTFUL, Verdict.LOST)


def worst(verdicts: Iterable[Verdict]) -> Verdict:
    """Returns the worst of the verdicts of several bodies; those without data do not count."""
    return max(verdicts, key=_FROM_GOOD_TO_BAD.index, default=Verdict.NO_DATA)


def check_verdicts(stored: NDArray[Any], frames: int) -> None:
    """Checks the verdicts of frames in a file.

    Raises:
        DataError: If they are not one word of ``Verdict`` for each frame.
    """
    words = [str(verdict) for verdict in Verdict]
    if stored.shape != (frames,):
        raise DataError(f"verdicts has the shape {stored.shape}; there are {frames} frames")
    if stored.dtype.kind != "U" or not np.isin(stored, words).all():
        raise DataError(f"verdicts holds other words than {', '.join(words)}")
