"""Workers of a Dask cluster, on this machine or on others that share its files."""

from __future__ import annotations

import logging
import time
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from queue import Empty, SimpleQueue
from typing import Any

from regkit import __version__
from regkit.experiment.lock import FolderLock
from regkit.experiment.progress import Progress
from regkit.experiment.task import Result, Task
from regkit.experiment.workers.packed import Packed, Performed, check_worker, performed
from regkit.experiment.workers.processes import PATIENCE
from regkit.experiment.workers.team import TRIES, Team, Workers
from regkit.system.errors import ConfigError, DataError, RegkitError
from regkit.system.optional import load_library

REACHED_WITHIN = 10.0
"""Maximum time [s] until a scheduler and its first worker answer."""

ALONE_FOR = 120.0
"""Maximum time [s] to wait without workers, which may be restarting."""


@dataclass(frozen=True)
class DaskCluster(Workers):
    """The workers of a Dask scheduler.

    Attributes:
        address: Of the scheduler, such as ``tcp://10.0.0.1:8786``.
    """

    address: str

    @property
    def described(self) -> str:
        """Description with the scheduler's address."""
        return f"the Dask cluster at {self.address}"

    @property
    def remote(self) -> bool:
        """True: tasks run in other processes."""
        return True

    @property
    def place(self) -> str:
        """Scheme and address, for messages."""
        return f"dask:{self.address}"

    @contextmanager
    def team(self) -> Iterator[Team]:
        """Connects to the workers; those that start later are used too.

        Raises:
            DependencyError: If Dask is not installed.
            ConfigError: If there is no scheduler, or it has no workers.
        """
        distributed = load_library("distributed")
        with _quiet():
            try:
                # A client with a wrong address prints a traceback when it is garbage-collected.
                distributed.comm.resolve_address(self.address)
                client = distributed.Client(
                    self.address, timeout=REACHED_WITHIN, set_as_default=False
                )
            except (OSError, ValueError) as error:
                reason = str(error).splitlines()[0]
                raise ConfigError(
                    f"there is no Dask scheduler: {reason}", place=self.place
                ) from None
            try:
                self._wait(client, distributed.TimeoutError)
                yield _DaskTeam(client, self.place)
            finally:
                client.close(timeout=REACHED_WITHIN)

    def _wait(self, client: Any, too_late: type[Exception]) -> None:
        try:
            client.wait_for_workers(1, timeout=REACHED_WITHIN)
        except too_late:
            raise ConfigError(
                f"the scheduler has no workers; start some: dask worker {self.address}",
                place=self.place,
            ) from None


@contextmanager
def _quiet() -> Iterator[None]:
    """Silences Dask's messages about lost connections, which the run reports itself."""
    loggers = [
        logging.getLogger(name)
        for name in list(logging.Logger.manager.loggerDict)
        if name.partition(".")[0] == "distributed"
    ]
    levels = [logger.level for logger in loggers]
    try:
        for logger in loggers:
            logger.setLevel(logging.CRITICAL)
        yield
    finally:
        for logger, level in zip(loggers, levels, strict=True):
            logger.setLevel(level)


def _answer(lock: FolderLock, version: str) -> str | None:
    """Runs on a worker: returns why it cannot serve, or None."""
    try:
        check_worker(lock, version)
    except RegkitError as error:
        return str(error)
    return None


class _DaskTeam(Team):
    """Sends at most one task per worker; Dask resends the task of a lost worker."""

    def __init__(self, client: Any, place: str) -> None:
        self._client, self._place = client, place
        self._lock: FolderLock | None = None
        self._ended: SimpleQueue[tuple[Task, Any]] = SimpleQueue()

    def serve(self, lock: FolderLock) -> None:
        """Checks every worker before any work begins."""
        self._lock = lock
        answers = self._client.run(_answer, lock, __version__, on_error="return")
        for worker, answer in answers.items():
            if answer is not None:
                raise ConfigError(f"the worker {worker} cannot serve: {answer}", place=self._place)

    def count(self) -> int:
        """Returns the current number of workers, regardless of their threads."""
        return self._workers()

    def begin(self, task: Task) -> None:
        """Sends a task to the scheduler."""
        assert self._lock is not None
        future = self._client.submit(performed, Packed.of(task, self._lock), pure=False)
        future.add_done_callback(lambda done: self._ended.put((task, done)))

    def ended(self, progress: Progress) -> tuple[Task, Result]:
        """Returns the next finished task."""
        alone_since: float | None = None
        while True:
            try:
                task, future = self._ended.get(timeout=PATIENCE)
            except Empty:
                progress.wait()
                alone = not self._workers()
                alone_since = (alone_since or time.monotonic()) if alone else None
                if alone_since is not None and time.monotonic() - alone_since > ALONE_FOR:
                    raise DataError("all workers are lost", place=self._place) from None
                continue
            return task, self._result(future)

    def _result(self, future: Any) -> Result:
        if future.status == "finished":
            done: Performed = future.result()
            return done.told()
        if future.status != "error":
            raise DataError("the scheduler is lost", place=self._place)
        error = future.exception()
        killed = load_library("distributed").KilledWorker
        if isinstance(error, killed):
            return RegkitError(f"its worker died {TRIES} times, perhaps for lack of memory")
        return RegkitError(f"a worker failed: {type(error).__name__}: {error}")

    def _workers(self) -> int:
        try:
            return len(self._client.nthreads())
        except (OSError, RuntimeError, ValueError):
            raise DataError("the scheduler is lost", place=self._place) from None
