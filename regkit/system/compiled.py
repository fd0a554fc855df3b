"""Loops over arrays, compiled by Numba when they are first called."""

from __future__ import annotations

from collections.abc import Callable
from functools import update_wrapper
from typing import Any, Generic, ParamSpec, TypeVar, cast

from regkit.system.optional import load_library

P = ParamSpec("P")
R = TypeVar("R")


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
            self._dispatcher = cast(
                Callable[P, R], load_library("numba").njit(cache=True)(self.function)
            )
        return self._dispatcher


def compiled(function: Callable[P, R]) -> Compiled[P, R]:
    """A function of loops over arrays, compiled by Numba when first called and kept on disk.

    The error of a missing Numba comes from the first call.
    """
    return Compiled(function)
