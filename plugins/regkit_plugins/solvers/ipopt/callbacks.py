"""CasADi callbacks through which IPOPT evaluates a program written in Python."""

from __future__ import annotations

import signal
import threading
from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager
from functools import lru_cache
from typing import Any

import numpy as np

from regkit.system.arrays import Array
from regkit.system.optional import load_library
from regkit_plugins.solvers.ipopt.program import Program
from regkit_plugins.solvers.ipopt.watch import Watch

Answer = Callable[[Sequence[Array]], Array]
"""Maps the arguments of a CasADi function to the values of one of its results."""


class Callbacks:
    """The functions of a program in the form of ``casadi.nlpsol``.

    An exception of the program cannot propagate through IPOPT. It is stored in ``failure``, and all
    further results are NaN, which makes IPOPT stop.

    Args:
        program: The program.
        watch: The watch that may stop IPOPT early.

    Attributes:
        nlp: The nonlinear program: x, f and g.
        derivatives: The options of ``nlpsol`` with the derivatives.
        failure: The exception of the program, if it raised one.
    """

    def __init__(self, program: Program, watch: Watch) -> None:
        ca = load_library("casadi")
        self.failure: BaseException | None = None
        dense, m, c = ca.Sparsity.dense, len(program.start), program.rows
        # CasADi stores the upper triangle column-major, which is the lower one row-major.
        triangle = np.tril_indices(m)
        value = (dense(1), lambda given: program.value(given[0]))
        rows = (dense(c), lambda given: program.constrained(given[0]))
        gradient = (dense(m), lambda given: program.gradient(given[0]))
        jacobian = (dense(c, m), lambda given: program.jacobian(given[0]).ravel(order="F"))
        curvature = (
            ca.Sparsity.upper(m),
            lambda given: program.curvature(given[0], given[2][0], given[3])[triangle],
        )
        point = [dense(m), dense(0, 0)]
        objective = self._function("objective", [dense(m)], [value])
        constraints = self._function("constraints", [dense(m)], [rows])
        self.derivatives = {
            "grad_f": self._function("gradient", point, [value, gradient]),
            "jac_g": self._function("jacobian", point, [rows, jacobian]),
        }
        if program.curved:
            lagrangian = [*point, dense(1), dense(c)]
            self.derivatives["hess_lag"] = self._function("curvature", lagrangian, [curvature])
        iterate = [dense(m), dense(1), dense(c), dense(m), dense(c), dense(0, 0)]
        ended = (dense(1), lambda given: np.array([float(watch.ended(given[0]))]))
        self.derivatives["iteration_callback"] = self._function("iteration", iterate, [ended])
        x = ca.MX.sym("x", m)
        self.nlp = {"x": x, "f": objective(x), "g": constraints(x)}
        # CasADi does not keep callbacks alive.
        self._kept = (objective, constraints)

    @contextmanager
    def interruptible(self) -> Iterator[None]:
        """Returns a context that stores Ctrl-C as a failure, which IPOPT's code would lose."""
        handler = signal.getsignal(signal.SIGINT)
        main = threading.current_thread() is threading.main_thread()
        if handler is not signal.default_int_handler or not main:
            yield
            return

        def keep(*_: object) -> None:
            self.failure = KeyboardInterrupt()

        signal.signal(signal.SIGINT, keep)
        try:
            yield
        finally:
            signal.signal(signal.SIGINT, handler)

    def _function(self, name: str, inputs: list[Any], results: Sequence[tuple[Any, Answer]]) -> Any:
        return _callback_class()(name, inputs, results, self._guarded)

    def _guarded(self, answer: Answer, given: Sequence[Array]) -> Array | float:
        if self.failure is None:
            try:
                return answer(given)
            except BaseException as failure:
                self.failure = failure
        return np.nan


@lru_cache(maxsize=1)
def _callback_class() -> type[Any]:
    """Returns the callback class, whose base class is imported from CasADi on first use."""

    # CasADi is untyped, so its classes have the type Any.
    class Callback(load_library("casadi").Callback):  # type: ignore[misc]
        """A CasADi function that evaluates Python functions without copies."""

        def __init__(
            self,
            name: str,
            inputs: list[Any],
            results: Sequence[tuple[Any, Answer]],
            guarded: Callable[[Answer, Sequence[Array]], Array | float],
        ) -> None:
            super().__init__()
            self._inputs, self._results, self._guarded = inputs, results, guarded
            self.construct(name, {})

        def get_n_in(self) -> int:
            return len(self._inputs)

        def get_n_out(self) -> int:
            return len(self._results)

        def get_sparsity_in(self, index: int) -> Any:
            return self._inputs[index]

        def get_sparsity_out(self, index: int) -> Any:
            return self._results[index][0]

        def has_eval_buffer(self) -> bool:
            return True

        def eval_buffer(self, arguments: Sequence[Any], results: Sequence[Any]) -> int:
            given = [np.zeros(0) if one is None else np.frombuffer(one) for one in arguments]
            for buffer, (_, answer) in zip(results, self._results, strict=True):
                # A result that IPOPT does not request has no buffer.
                if buffer is not None:
                    np.frombuffer(buffer)[:] = self._guarded(answer, given)
            return 0

    return Callback
