"""Reading of recorded hand poses from the binary files of handy-work."""

from __future__ import annotations

from pathlib import Path

import numpy as np

from regkit.system.errors import DataError
from regkit_synthesis.hands.pose import PARENTS, WRIST, HandPose

JOINTS = (WRIST, *PARENTS)
"""The 25 joints of WebXR, in the order of the specification and of the files."""

_NUMBERS = 1 + 2 * len(JOINTS) * (16 + 1)
"""Layout of a file: number of joints, matrices of the left and the right hand, weights."""


def read_handywork(path: Path) -> HandPose:
    """Reads the right hand of a handy-work pose.

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
    # The matrices are column-major.
    matrices = right.transpose(0, 2, 1)
    return HandPose.of(dict(zip(JOINTS, matrices, strict=True)))
