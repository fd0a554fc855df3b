"""Loops over arrays, compiled by Numba when they are first called."""

from __future__ import annotations

import importlib
from collections.abc import Callable
from functools import update_wrapper
from typing import Any, Generic, ParamSpec, TypeVar, cast

from regkit.system.optional import load_library

P = ParamSpec("P")
R = TypeVar("R")

_DISPATCHERS: list[Any] = []
"""What Numba made of the functions so far."""

_TELLERS: list[Callable[[], None]] = []
"""Who wants to know that loops are compiled."""


class Compiled(Generic[P, R]):
    """A function that Numba compiles at its first call, and keeps on disk.

    Numba takes half a second to import, which no command that registers nothing should wait for.
    """

    def __init__(self, function: Callable[P, R]) -> None:
        self.function = function
        self._dispatcher: Callable[P, R] | None = None
        update_wrapper(self, function)

    def __call__(self, *args: P.args, **kwargs: P.kwargs) -> R:
        """The function's value, by machine code."""
        return (self._dispatcher or self.dispatcher())(*args, **kwargs)

    def dispatcher(self) -> Callable[P, R]:
        """What Numba made of the function."""
        if self._dispatcher is None:
            names = cast(Any, self.function).__globals__
            # Numba knows its own functions only: those that this one calls stand in its globals.
            for name in self.function.__code__.co_names:
                if isinstance(names.get(name), Compiled):
                    names[name] = names[name].dispatcher()
            _listen()
            self._dispatcher = cast(
                Callable[P, R], load_library("numba").njit(cache=True)(self.function)
            )
            _DISPATCHERS.append(self._dispatcher)
        return self._dispatcher


def compiled(function: Callable[P, R]) -> Compiled[P, R]:
    """A function of loops over arrays, compiled by Numba when first called and kept on disk.

    The error of a missing Numba comes from the first call.
    """
    return Compiled(function)


def loaded_loops() -> int:
    """How many loops are compiled or loaded from disk so far, one for each set of types.

    A time in which this number grows is not that of the loops.
    """
    return sum(len(dispatcher.overloads) for dispatcher in _DISPATCHERS)


def when_compiling(tell: Callable[[], None]) -> None:
    """Have ``tell`` called once, when loops are compiled that are not on disk."""
    _TELLERS.append(tell)


def _listen() -> None:
    """Tell who wants to know that Numba compiles, before it begins."""
    if not _TELLERS or _DISPATCHERS:
        return
    load_library("numba")
    event = importlib.import_module("numba.core.event")

    class Listener(event.Listener):  # type: ignore[misc, name-defined]
        def on_start(self, _: Any) -> None:
            while _TELLERS:
                _TELLERS.pop()()

        def on_end(self, _: Any) -> None:
            """Nothing to tell."""

    event.register("numba:compile", Listener())
