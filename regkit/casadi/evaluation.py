"""CasADi functions as functions of arrays."""

from __future__ import annotations

from threading import Lock
from typing import Any

import numpy as np

from regkit.system.arrays import Array


class Evaluation:
    """A CasADi function of dense vectors, with one dense result, called without copies of its own.

    Calling a CasADi function with arrays costs tens of microseconds, most of it conversion; through
    its buffer it costs a few.

    Args:
        function: The function.
    """

    def __init__(self, function: Any) -> None:
        # One function serves all registrars of a skeleton, which may be of several threads.
        self._lock = Lock()
        self._arguments = [np.zeros(function.size1_in(i)) for i in range(function.n_in())]
        self._result = np.zeros(function.size_out(0), order="F")
        # The buffer must be kept: its trigger points into it.
        self._function, (self._buffer, self._trigger) = function, function.buffer()
        for index, argument in enumerate(self._arguments):
            self._buffer.set_arg(index, argument.data)
        self._buffer.set_res(0, self._result.ravel(order="K").data)

    def __call__(self, *arguments: Array) -> Array:
        """The result, a matrix, for one vector for each argument."""
        with self._lock:
            for own, given in zip(self._arguments, arguments, strict=True):
                own[:] = given
            self._trigger()
            return self._result.copy()
