"""Functions with loops over arrays, compiled by Numba on their first call."""

from __future__ import annotations

import importlib
from collections.abc import Callable
from functools import update_wrapper
from threading import RLock
from typing import Any, Generic, ParamSpec, TypeVar, cast

from regkit.system.optional import load_library

P = ParamSpec("P")
R = TypeVar("R")

_DISPATCHERS: list[Any] = []
"""Numba's dispatchers of all functions compiled so far."""

_LOCK = RLock()
"""Held while a dispatcher is made, and those of the functions that it calls."""

_CALLBACKS: list[Callable[[], None]] = []
"""Callbacks to run once before the first compilation."""


class Compiled(Generic[P, R]):
    """A function that Numba compiles on its first call and caches on disk.

    Importing Numba takes half a second, which commands without a registration avoid.
    """

    def __init__(self, function: Callable[P, R]) -> None:
        self.function = function
        self._dispatcher: Callable[P, R] | None = None
        update_wrapper(self, function)

    def __call__(self, *args: P.args, **kwargs: P.kwargs) -> R:
        """Calls the compiled function."""
        return (self._dispatcher or self.dispatcher())(*args, **kwargs)

    def dispatcher(self) -> Callable[P, R]:
        """Returns Numba's dispatcher of the function."""
        # Threads of one computation may make the first call at the same time.
        with _LOCK:
            if self._dispatcher is None:
                names = cast(Any, self.function).__globals__
                # Numba calls only its own functions: replace those in the globals of this one.
                for name in self.function.__code__.co_names:
                    if isinstance(names.get(name), Compiled):
                        names[name] = names[name].dispatcher()
                _listen()
                # All loops release Python's lock, so that threads can share a computation.
                self._dispatcher = cast(
                    Callable[P, R],
                    load_library("numba").njit(cache=True, nogil=True)(self.function),
                )
                _DISPATCHERS.append(self._dispatcher)
            return self._dispatcher


def compiled(function: Callable[P, R]) -> Compiled[P, R]:
    """Decorator: compiles a function by Numba on its first call and caches it on disk.

    If Numba is missing, the first call raises DependencyError.
    """
    return Compiled(function)


def loaded_loops() -> int:
    """Returns the number of loops compiled or loaded from disk so far, one per signature.

    A time measurement during which this number grows includes compilation.
    """
    return sum(len(dispatcher.overloads) for dispatcher in _DISPATCHERS)


def when_compiling(callback: Callable[[], None]) -> None:
    """Calls ``callback`` once, before the first compilation of a loop not cached on disk."""
    _CALLBACKS.append(callback)


def _listen() -> None:
    """Registers the callbacks with Numba before its first compilation."""
    if not _CALLBACKS or _DISPATCHERS:
        return
    load_library("numba")
    event = importlib.import_module("numba.core.event")

    class Listener(event.Listener):  # type: ignore[misc, name-defined]
        def on_start(self, _: Any) -> None:
            while _CALLBACKS:
                _CALLBACKS.pop()()

        def on_end(self, _: Any) -> None:
            """Ignored."""

    event.register("numba:compile", Listener())
