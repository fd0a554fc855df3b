"""Messages about violated laws for the author of a plug-in: by how much, and where to look."""

from __future__ import annotations

import copy
import inspect
from collections.abc import Iterator, Mapping
from contextlib import contextmanager
from contextvars import ContextVar
from dataclasses import fields, is_dataclass
from typing import Any

import numpy as np
import pytest

from regkit.config.plugin import Plugin

_SUSPECT: ContextVar[Plugin | None] = ContextVar("the only one under test of a pair", default=None)


@contextmanager
def suspecting(plugin: Plugin | None) -> Iterator[None]:
    """Context manager whose violated laws name ``plugin`` first, the one of a pair under test."""
    token = _SUSPECT.set(plugin)
    try:
        yield
    finally:
        _SUSPECT.reset(token)


def require(kept: bool | np.bool_, plugin: Plugin, broken: str, *, look_at: object) -> None:
    """Fails the test unless a law holds.

    Args:
        kept: Whether it holds.
        plugin: The plug-in under test.
        broken: What is wrong and by how much, worded to follow the plug-in's name.
        look_at: The class or method to correct.
    """
    if kept:
        return
    suspect = _SUSPECT.get()
    if suspect is None:
        pytest.fail(f"{_named(plugin)} {broken}; look at {whereabouts(look_at)}", pytrace=False)
    # The partner passes with other shapes, so the fault is most likely not in its file.
    pytest.fail(
        f"{_named(suspect)} violates a law together with {_named(plugin)}: look first at "
        f"{whereabouts(type(suspect))}. The {_named(plugin)} {broken}; that is in "
        f"{whereabouts(look_at)}",
        pytrace=False,
    )


def _named(plugin: Plugin) -> str:
    """Returns the group and the kind of a plug-in."""
    return f"{plugin.group.removeprefix('regkit.').removesuffix('s')} '{plugin.kind}'"


def whereabouts(what: object) -> str:
    """Returns name, file and line of a class or a method."""
    found = inspect.unwrap(getattr(what, "__func__", what))  # type: ignore[arg-type]
    name = f"{getattr(found, '__module__', '')}.{getattr(found, '__qualname__', found)}"
    try:
        file = inspect.getsourcefile(found)
        line = inspect.getsourcelines(found)[1]
    except (OSError, TypeError):
        return name
    return f"{name} ({file}:{line})"


def copied(value: Any) -> Any:
    """Returns a deep copy, with which ``same`` can detect changes of the value later."""
    return copy.deepcopy(value)


def same(first: Any, second: Any) -> bool:
    """Whether two values are equal to the last bit, through dataclasses, arrays and sequences."""
    if isinstance(first, np.ndarray):
        real = first.dtype.kind in "fc"
        return isinstance(second, np.ndarray) and np.array_equal(first, second, equal_nan=real)
    if is_dataclass(first) and not isinstance(first, type):
        return type(first) is type(second) and all(
            same(getattr(first, each.name), getattr(second, each.name)) for each in fields(first)
        )
    if isinstance(first, Mapping):
        return first.keys() == second.keys() and all(same(first[k], second[k]) for k in first)
    if isinstance(first, list | tuple):
        return len(first) == len(second) and all(map(same, first, second))
    if isinstance(first, float):
        return bool(first == second or (first != first and second != second))
    return bool(first == second)
