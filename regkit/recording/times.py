"""Times of a recording's frames in ``times.csv``: rows of frame,time_s."""

from __future__ import annotations

import math
from pathlib import Path

import numpy as np

from regkit.clouds.formats.text.lines import lines_of
from regkit.system.arrays import Array
from regkit.system.errors import DataError
from regkit.system.guard import reading
from regkit.system.plain_numbers import real, whole
from regkit.system.printable import shortened

FILE = "times.csv"
"""Name of the file in the recording's folder."""

HEADER = "frame,time_s"

MAX_TIME = 1e12
"""Largest time [s]; clocks count from 1970, or from the start of a machine."""


def read_times(path: Path, length: int) -> Array | None:
    """Returns the times (length,) [s] of the first frames; None if the file is missing.

    They may go back, as the clock that measured them did.

    Further rows are not read: whoever records writes a frame's time before its image, so that the
    last row may be incomplete, and belong to an image that was not written.

    Raises:
        DataError: If a row cannot be read or is missing.
    """
    if not path.exists():
        return None
    with reading(path, "a file of times"):
        header, *lines = lines_of(path)
        if header.strip() != HEADER:
            raise DataError(
                f"the header must be {HEADER}; it is {shortened(header, 100)}", place=f"{path}:1"
            )
        times: list[float] = []
        for number, line in enumerate(lines[:length], 2):
            times.append(_time(line, len(times), f"{path}:{number}"))
        if len(times) < length:
            raise DataError(f"there are {length} frames, but {len(times)} times")
        return np.array(times)


def _time(line: str, frame: int, place: str) -> float:
    """Returns the time [s] of a row, which must be that of ``frame``."""
    try:
        number, time = line.split(",")
        if whole(number) != frame or not math.isfinite(real(time)):
            raise ValueError
    except ValueError:
        raise DataError(
            f"a row of the frame {frame} and its time [s] must stand here: {shortened(line, 100)}",
            place=place,
        ) from None
    if abs(real(time)) > MAX_TIME:
        raise DataError(f"no clock shows {shortened(time, 100)} s", place=place)
    return real(time)
