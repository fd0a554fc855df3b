"""A window of the last values of a series, whose quantiles are known at any time."""

from __future__ import annotations

from array import array
from bisect import bisect_left
from dataclasses import dataclass, field
from math import isnan, nan

WINDOW = 1000
"""Number of values that a window holds, enough to determine what is usual in a recording."""


def _nothing() -> array[float]:
    return array("d")


@dataclass(frozen=True)
class Window:
    """The last ``WINDOW`` known values of a series.

    They are kept in both orders, so that nothing is sorted anew for a quantile. The arrays are
    never changed; a new value copies them, which is faster than a tree for so few bytes.

    Attributes:
        latest: The values, the latest last.
        ascending: The same values, the largest last.
    """

    latest: array[float] = field(default_factory=_nothing)
    ascending: array[float] = field(default_factory=_nothing)

    def __len__(self) -> int:
        """Number of values."""
        return len(self.latest)

    def followed_by(self, value: float) -> Window:
        """Returns the window after one more value, which is left out if it is unknown (NaN)."""
        if isnan(value):
            return self
        latest, ascending, new = self.latest, self.ascending, array("d", (value,))
        if len(latest) == WINDOW:
            oldest = bisect_left(ascending, latest[0])
            ascending = ascending[:oldest] + ascending[oldest + 1 :]
            latest = latest[1:]
        at = bisect_left(ascending, value)
        return Window(latest + new, ascending[:at] + new + ascending[at:])

    def quantile(self, share: float) -> float:
        """Returns the value below which a ``share`` of the values lies, 0 to 1; NaN of no values.

        It is interpolated linearly between the two nearest values.
        """
        if not len(self):
            return nan
        place = share * (len(self) - 1)
        below = int(place)
        low, high = self.ascending[below], self.ascending[min(below + 1, len(self) - 1)]
        return low + (place - below) * (high - low)
