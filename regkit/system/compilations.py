"""Watches the compilation of loops: counts them, and tells when the first one begins."""

from __future__ import annotations

import gc
import importlib
from collections.abc import Callable
from typing import Any

from regkit.system.compile_ahead import compile_ahead
from regkit.system.optional import load_library

DISPATCHERS: list[Any] = []
"""Numba's dispatchers of all functions compiled so far."""

_CALLBACKS: list[Callable[[], None]] = []
"""Callbacks to run once before the first compilation."""


def loaded_loops() -> int:
    """Returns the number of loops compiled or loaded from disk so far, one per signature.

    A time measurement during which this number grows includes compilation.
    """
    return sum(len(dispatcher.overloads) for dispatcher in DISPATCHERS)


def when_compiling(callback: Callable[[], None]) -> None:
    """Calls ``callback`` once, before the first compilation of a loop not cached on disk."""
    _CALLBACKS.append(callback)


def listen() -> None:
    """Watches Numba's compilations, from before the first one on."""
    if DISPATCHERS:
        return
    load_library("numba")
    event = importlib.import_module("numba.core.event")

    class Listener(event.Listener):  # type: ignore[misc, name-defined]
        """Runs the callbacks, and pauses the collection of garbage, of which there is none.

        Numba builds millions of small objects for a function; looking through them again and again
        takes a tenth of the time.
        """

        depth, collecting = 0, True

        def on_start(self, _: Any) -> None:
            while _CALLBACKS:
                _CALLBACKS.pop()()
            compile_ahead()
            if not self.depth:
                self.collecting = gc.isenabled()
                gc.disable()
            self.depth += 1

        def on_end(self, _: Any) -> None:
            self.depth -= 1
            if not self.depth and self.collecting:
                gc.enable()

    event.register("numba:compile", Listener())
