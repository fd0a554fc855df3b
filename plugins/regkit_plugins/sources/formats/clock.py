"""Times of frames."""

from __future__ import annotations

import math

from regkit.system.errors import DataError


def checked_time(time: float, *, place: str) -> float:
    """Returns the time [s] that a frame gives; it may be before that of the last frame.

    Raises:
        DataError: If it is not finite.
    """
    if not math.isfinite(time):
        raise DataError(f"the frame's time is {time}, no finite number", place=place)
    return time
