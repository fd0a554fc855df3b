"""Pools of one process, by joblib's loky: each worker is one, so that it is known what it does."""

from __future__ import annotations

import os
import signal
import sys
import threading
import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from multiprocessing import resource_tracker
from typing import Any

from regkit.system.notes import show_notes
from regkit.system.optional import load_library

ONE_THREAD = {
    f"{name}_NUM_THREADS": "1" for name in ("OMP", "OPENBLAS", "MKL", "NUMBA", "VECLIB_MAXIMUM")
}


def pool_of_one(prepare: Callable[[], None] | None = None) -> Any:
    """Returns an executor of one process, which starts on first use and ends with this one.

    Args:
        prepare: Called in the process before its first task, and in each that replaces it.
    """
    return _loky().ProcessPoolExecutor(
        max_workers=1, env=ONE_THREAD, initializer=_begin, initargs=(os.getpid(), prepare)
    )


def broken_pool() -> type[BaseException]:
    """Returns the class of the error of a pool whose process has died."""
    broken: type[BaseException] = _loky().BrokenProcessPool
    return broken


@contextmanager
def deaf_children() -> Iterator[None]:
    """Context manager: processes started in it ignore Ctrl-C, even while they import.

    They inherit the blocked signal; in this process it is only delayed.
    """
    if sys.platform == "win32":
        yield
        return
    # Python starts its tracker of resources with the first process, and unblocks the signal then.
    resource_tracker.ensure_running()
    former = signal.pthread_sigmask(signal.SIG_BLOCK, {signal.SIGINT})
    try:
        yield
    finally:
        signal.pthread_sigmask(signal.SIG_SETMASK, former)


def _loky() -> Any:
    return load_library("joblib.externals.loky")


def _begin(parent: int, prepare: Callable[[], None] | None) -> None:
    """Runs on a worker when it starts."""
    _follow_parent(parent)
    if prepare is not None:
        prepare()


def _follow_parent(parent: int) -> None:
    """Runs on a worker: ends it with its parent, leaves Ctrl-C to the parent, and shows notes."""
    show_notes()
    signal.signal(signal.SIGINT, signal.SIG_IGN)

    def follow() -> None:
        # Windows always reports the same number; there a worker ends with its task.
        while os.getppid() == parent:
            time.sleep(1.0)
        os._exit(1)

    threading.Thread(target=follow, daemon=True).start()
