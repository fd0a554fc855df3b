"""Who looks at IPOPT's iterates, and ends it early."""

from __future__ import annotations

import time

import numpy as np

from regkit.system.arrays import Array
from regkit_plugins.solvers.ipopt.program import Program

SETTLED = "the value settled"
LATE = "max_seconds ran out"


class Watch:
    """Looks at IPOPT's iterates, and ends it early.

    Args:
        program: The program.
        value_tolerance: It ends near a point within the limits, with a step that gains less than
            this part of all gain before.
        max_seconds: It ends after this time [s].

    Attributes:
        ending: Why it ended, or nothing.
    """

    def __init__(self, program: Program, value_tolerance: float, max_seconds: float | None) -> None:
        self.ending = ""
        self._program, self._tolerance = program, value_tolerance
        self._deadline = np.inf if max_seconds is None else time.perf_counter() + max_seconds
        self._first: float | None = None
        self._last = np.inf

    def ended(self, x: Array) -> bool:
        """Whether to end at an iterate x (m,)."""
        value = self._program.at(x)[0]
        gain, self._last = self._last - value, value
        if self._first is None:
            self._first = value
        little = self._tolerance * (self._first - value)
        if time.perf_counter() > self._deadline:
            self.ending = LATE
        elif 0.0 <= gain <= little:
            point = self._program.within(x)
            if self._program.allowed(point) and self._program.at(point)[0] <= value + little:
                self.ending = SETTLED
        return bool(self.ending)
