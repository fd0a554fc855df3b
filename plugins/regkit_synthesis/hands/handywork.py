"""Recorded hand poses in the binary files of handy-work."""

from __future__ import annotations

from pathlib import Path

import numpy as np

from regkit.system.errors import DataError
from regkit_synthesis.hands.pose import PARENTS, WRIST, HandPose

JOINTS = (WRIST, *PARENTS)
"""The 25 joints of WebXR in its order, which is that of the files."""

_NUMBERS = 1 + 2 * len(JOINTS) * (16 + 1)
"""How many joints there are; a matrix for each of the left hand and the right; then weights."""


def read_handywork(path: Path) -> HandPose:
    """Read the right hand of one of handy-work's poses.

    Raises:
        DataError: If the file is missing or does not have the 25 joints of WebXR for both hands.
    """
    try:
        numbers = np.fromfile(path, dtype="<f4").astype(np.float64)
    except FileNotFoundError:
        raise DataError("the file is missing; it holds a hand pose", place=str(path)) from None
    if len(numbers) != _NUMBERS or numbers[0] != len(JOINTS):
        raise DataError(
            f"not a pose of handy-work; it must have {_NUMBERS} numbers of 4 bytes, of which the "
            f"first is {len(JOINTS)}",
            place=str(path),
        )
    _, right = numbers[1 : 1 + 2 * len(JOINTS) * 16].reshape(2, len(JOINTS), 4, 4)
    # The matrices are stored by columns.
    matrices = right.transpose(0, 2, 1)
    return HandPose.of(dict(zip(JOINTS, matrices, strict=True)))
