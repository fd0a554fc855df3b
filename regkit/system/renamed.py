"""Renamed arguments of the Python API: an old name is answered with the new one."""

from __future__ import annotations

from collections.abc import Callable
from functools import wraps
from typing import ParamSpec, TypeVar

P = ParamSpec("P")
R = TypeVar("R")


def renamed_arguments(**names: str) -> Callable[[Callable[P, R]], Callable[P, R]]:
    """Decorator of a function with renamed keyword arguments.

    Args:
        names: New names of the arguments by their old ones.
    """

    def decorated(function: Callable[P, R]) -> Callable[P, R]:
        @wraps(function)
        def checked(*args: P.args, **kwargs: P.kwargs) -> R:
            for old in kwargs.keys() & names.keys():
                raise TypeError(
                    f"{function.__name__}() has no argument '{old}'; it is now called "
                    f"'{names[old]}'"
                )
            return function(*args, **kwargs)

        return checked

    return decorated
