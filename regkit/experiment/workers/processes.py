"""Worker processes on this machine, by joblib's loky."""

from __future__ import annotations

import os
import signal
import sys
import threading
import time
from collections import Counter
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from multiprocessing import resource_tracker
from queue import Empty, SimpleQueue
from typing import Any

from regkit.experiment.lock import FolderLock
from regkit.experiment.progress import Progress
from regkit.experiment.task import Result, Task
from regkit.experiment.workers.packed import Packed, performed
from regkit.experiment.workers.team import TRIES, Team, Workers
from regkit.system.errors import RegkitError
from regkit.system.notes import show_notes
from regkit.system.optional import load_library

PATIENCE = 0.2
"""Interval [s] at which the progress is updated while waiting for a task."""

ONE_THREAD = {
    f"{name}_NUM_THREADS": "1" for name in ("OMP", "OPENBLAS", "MKL", "NUMBA", "VECLIB_MAXIMUM")
}


@dataclass(frozen=True)
class Processes(Workers):
    """Worker processes on this machine.

    Attributes:
        jobs: Number of processes.
    """

    jobs: int

    @property
    def described(self) -> str:
        """Description with the number of processes."""
        return f"{self.jobs} processes"

    @property
    def remote(self) -> bool:
        """True: tasks run in other processes."""
        return True

    @contextmanager
    def team(self) -> Iterator[Team]:
        """Starts the processes, and kills them at the end: all finished work is on disk."""
        team = _ProcessTeam(self.jobs)
        try:
            yield team
        finally:
            team.leave()


class _ProcessTeam(Team):
    """Each worker is a pool of one process, so that a dead process identifies its task."""

    def __init__(self, jobs: int) -> None:
        self._lock: FolderLock | None = None
        self._idle = [_pool() for _ in range(jobs)]
        self._busy: dict[Task, Any] = {}
        self._deaths: Counter[Task] = Counter()
        self._ended: SimpleQueue[tuple[Task, Any]] = SimpleQueue()
        self._jobs = jobs

    def serve(self, lock: FolderLock) -> None:
        """Needs no check: local processes see the same files."""
        self._lock = lock

    def count(self) -> int:
        """Returns the number of processes."""
        return self._jobs

    def begin(self, task: Task) -> None:
        """Sends a task to an idle process, which starts on first use."""
        assert self._lock is not None
        pool = self._busy[task] = self._idle.pop()
        with _deaf_children():
            future = pool.submit(performed, Packed.of(task, self._lock))
        future.add_done_callback(lambda done: self._ended.put((task, done)))

    def ended(self, progress: Progress) -> tuple[Task, Result]:
        """Returns the next finished task; the task of a dead process is retried a few times."""
        while True:
            try:
                task, future = self._ended.get(timeout=PATIENCE)
            except Empty:
                progress.wait()
                continue
            pool, error = self._busy.pop(task), future.exception()
            if error is None:
                self._idle.append(pool)
                return task, future.result()
            pool.shutdown(wait=False, kill_workers=True)
            self._idle.append(_pool())
            if not isinstance(error, _loky().BrokenProcessPool):
                return task, RegkitError(f"its result cannot be received: {error}")
            self._deaths[task] += 1
            if self._deaths[task] == TRIES:
                return task, RegkitError(
                    f"its process died {TRIES} times, perhaps for lack of memory; if so, use fewer "
                    "processes"
                )
            self.begin(task)

    def leave(self) -> None:
        """Kills all processes."""
        for pool in [*self._idle, *self._busy.values()]:
            pool.shutdown(wait=True, kill_workers=True)


def _loky() -> Any:
    return load_library("joblib.externals.loky")


def _pool() -> Any:
    return _loky().ProcessPoolExecutor(
        max_workers=1, env=ONE_THREAD, initializer=_follow_parent, initargs=(os.getpid(),)
    )


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


@contextmanager
def _deaf_children() -> Iterator[None]:
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
