"""Reading of recorded hand poses from the JavaScript files of iwer."""

from __future__ import annotations

import re
from pathlib import Path

import numpy as np

from regkit.geometry.rigid import checked_rigid
from regkit.system.arrays import Array
from regkit.system.errors import DataError
from regkit.system.guard import reading
from regkit.system.plain_numbers import real
from regkit_synthesis.hands.pose import PARENTS, WRIST, HandPose

_JOINT = re.compile(r"(?<![a-z-])'?([a-z-]+)'?:\s*\{\s*offsetMatrix:\s*\[([^\]]*)\]")


def read_iwer(path: Path) -> HandPose:
    """Reads an iwer pose, which is of a left hand, and mirrors it to a right hand.

    Raises:
        DataError: If the file is missing or does not have the 25 joints of WebXR.
    """
    with reading(path, "a hand pose of iwer"):
        text = path.read_text(encoding="utf-8")
    matrices = {name: _matrix(numbers, path) for name, numbers in _JOINT.findall(text)}
    missing = [joint for joint in (WRIST, *PARENTS) if joint not in matrices]
    if missing:
        raise DataError(
            f"no offsetMatrix for {', '.join(missing)}; all 25 joints of WebXR must be there",
            place=str(path),
        )
    mirror = np.diag([-1.0, 1.0, 1.0, 1.0])
    with reading(path, "a hand pose of iwer"):
        return HandPose.of({joint: mirror @ matrix @ mirror for joint, matrix in matrices.items()})


def _matrix(numbers: str, path: Path) -> Array:
    """Returns the matrix (4, 4) of 16 column-major numbers."""
    try:
        values = np.array([real(number) for number in numbers.split(",") if number.strip()])
        matrix = values.reshape(4, 4, order="F")
    except ValueError as error:
        raise DataError(f"an offsetMatrix is not 16 numbers ({error})", place=str(path)) from None
    # The stored matrix is used as it is, so that what is made from it keeps its last digit.
    checked_rigid(matrix, place=str(path))
    return matrix
