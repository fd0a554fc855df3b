"""Worker processes on this machine, by joblib's loky."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from queue import Empty, SimpleQueue
from typing import Any

from regkit.experiment.lock import FolderLock
from regkit.experiment.progress import Progress
from regkit.experiment.task import Result, Task
from regkit.experiment.workers.packed import Packed, performed
from regkit.experiment.workers.team import TRIES, Team, Workers
from regkit.system.errors import RegkitError
from regkit.system.processes import broken_pool, deaf_children, pool_of_one

PATIENCE = 0.2
"""Interval [s] at which the progress is updated while waiting for a task."""


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
        self._idle = [pool_of_one() for _ in range(jobs)]
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
        with deaf_children():
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
                return task, future.result().told()
            pool.shutdown(wait=False, kill_workers=True)
            self._idle.append(pool_of_one())
            if not isinstance(error, broken_pool()):
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
