"""Threads for one computation: fixed chunks of compiled loops, on as many threads as are allowed.

Compiled loops release Python's lock. A computation is divided into the same chunks whatever the
number of threads, and results are combined in the order of the chunks, so that they are equal to
the last bit.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from concurrent.futures import ThreadPoolExecutor
from contextlib import contextmanager
from contextvars import ContextVar
from typing import TypeVar

from regkit.system.errors import ConfigError

T = TypeVar("T")
R = TypeVar("R")

MOST = 64
"""Largest number of chunks of a computation."""

_POOL: ContextVar[ThreadPoolExecutor | None] = ContextVar("pool", default=None)
"""The threads of the current computation; a thread of a pool has none of its own."""


@contextmanager
def using_threads(count: int | None) -> Iterator[None]:
    """Context manager: computations in chunks use ``count`` threads; None leaves it as it is.

    Raises:
        ConfigError: If ``count`` is less than one.
    """
    if count is not None and count < 1:
        raise ConfigError(f"{count} threads; at least one is needed", place="threads")
    if count is None:
        yield
        return
    if count == 1:
        token = _POOL.set(None)
        try:
            yield
        finally:
            _POOL.reset(token)
        return
    with ThreadPoolExecutor(count, thread_name_prefix="regkit") as pool:
        token = _POOL.set(pool)
        try:
            yield
        finally:
            _POOL.reset(token)


def each(function: Callable[[T], R], items: Sequence[T]) -> list[R]:
    """Returns the results of independent calls in the order of the items."""
    pool = _POOL.get()
    if pool is None or len(items) < 2:
        return [function(item) for item in items]
    return list(pool.map(function, items))


def in_chunks(loop: Callable[[int, int], R], count: int, least: int) -> list[R]:
    """Returns the results of a loop over ``count`` items, called for at most ``MOST`` chunks.

    Args:
        loop: Called with the first item of a chunk and the one after its last.
        count: Number of items.
        least: Least number of items of a chunk, enough to be worth a task.
    """
    size = max(least, -(-count // MOST))
    begins = range(0, count, size)
    return each(lambda begin: loop(begin, min(begin + size, count)), begins)
