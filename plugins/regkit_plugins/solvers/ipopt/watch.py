"""Early termination of IPOPT."""

from __future__ import annotations

import time

import numpy as np

from regkit.system.arrays import Array
from regkit_plugins.solvers.ipopt.program import Program

SETTLED = "the value converged"
LATE = "max_seconds reached"


class Watch:
    """Monitors IPOPT's iterates, and stops it early.

    Args:
        program: The program.
        value_tolerance: IPOPT stops close to a feasible point if a step decreases the value by less
            than this fraction of the total decrease.
        max_seconds: IPOPT stops after this time [s].

    Attributes:
        ending: The reason of termination; empty before.
    """

    def __init__(self, program: Program, value_tolerance: float, max_seconds: float | None) -> None:
        self.ending = ""
        self._program, self._tolerance = program, value_tolerance
        self._deadline = np.inf if max_seconds is None else time.perf_counter() + max_seconds
        self._first: float | None = None
        self._last = np.inf

    def ended(self, x: Array) -> bool:
        """Returns whether to stop at an iterate x (m,)."""
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
