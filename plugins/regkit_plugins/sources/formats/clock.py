"""Times of frames that do not go back."""

from __future__ import annotations

import math

from regkit.system.errors import DataError


class Clock:
    """The time of the last frame, with which that of the next one is compared."""

    def __init__(self) -> None:
        self._last = -math.inf

    def at(self, time: float, *, place: str) -> float:
        """Returns the time [s] of the next frame.

        Args:
            time: The time that the frame gives.
            place: The frame, for messages.

        Raises:
            DataError: If it is before that of the last frame, or not finite.
        """
        if not math.isfinite(time) or time < self._last:
            raise DataError(
                f"the frame's time {time:.6f} s is before that of the frame before it, "
                f"{self._last:.6f} s",
                place=place,
            )
        self._last = time
        return time
