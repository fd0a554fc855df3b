"""Reading of recorded hand poses from the binary files of handy-work."""

from __future__ import annotations

from pathlib import Path

import numpy as np

from regkit.system.errors import DataError
from regkit.system.guard import reading
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
    with reading(path, "a hand pose of handy-work"):
        stored = np.fromfile(path, dtype="<f4")
    finite = bool(np.isfinite(stored).all())
    if len(stored) != _NUMBERS or not finite or stored[0] != len(JOINTS):
        raise DataError(
            f"not a pose of handy-work; it must have {_NUMBERS} finite numbers of 4 bytes, of "
            f"which the first is {len(JOINTS)}",
            place=str(path),
        )
    numbers = stored.astype(np.float64)
    _, right = numbers[1 : 1 + 2 * len(JOINTS) * 16].reshape(2, len(JOINTS), 4, 4)
    # The matrices are column-major.
    matrices = right.transpose(0, 2, 1)
    with reading(path, "a hand pose of handy-work"):
        return HandPose.of(dict(zip(JOINTS, matrices, strict=True)))
