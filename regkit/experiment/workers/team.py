"""The interface of workers, and this process as the only one."""

from __future__ import annotations

from abc import ABC, abstractmethod
from contextlib import AbstractContextManager
from types import TracebackType

from regkit.experiment.lock import FolderLock
from regkit.experiment.progress import Progress
from regkit.experiment.task import Result, Task

TRIES = 3
"""Number of worker deaths after which a task counts as failed."""


class Team(ABC):
    """Workers of one run."""

    @abstractmethod
    def serve(self, lock: FolderLock) -> None:
        """Prepares the workers for the run that holds a results folder.

        Raises:
            RegkitError: If a worker cannot serve it.
        """

    @abstractmethod
    def count(self) -> int:
        """Returns the number of tasks that can run at once at the moment."""

    @abstractmethod
    def begin(self, task: Task) -> None:
        """Gives a task to an idle worker."""

    @abstractmethod
    def ended(self, progress: Progress) -> tuple[Task, Result]:
        """Waits for the next task to end, and returns it; ``progress`` is updated meanwhile.

        Raises:
            RegkitError: If all workers are lost.
        """


class Workers(ABC):
    """A choice of workers."""

    @abstractmethod
    def team(self) -> AbstractContextManager[Team]:
        """Context manager of the workers of a run, released at its end.

        Raises:
            RegkitError: If they are not available.
        """

    @property
    @abstractmethod
    def described(self) -> str:
        """Description in ``environment.json``."""

    @property
    @abstractmethod
    def remote(self) -> bool:
        """Whether tasks run in other processes."""


class ThisProcess(Workers, Team):
    """No workers: tasks run in this process, one after the other."""

    def __init__(self) -> None:
        self._task: Task | None = None

    @property
    def described(self) -> str:
        """Description as one process."""
        return "1 process"

    @property
    def remote(self) -> bool:
        """Here."""
        return False

    def team(self) -> AbstractContextManager[Team]:
        """Returns itself."""
        return self

    def __enter__(self) -> Team:
        """Needs no preparation."""
        return self

    def __exit__(
        self,
        kind: type[BaseException] | None,
        error: BaseException | None,
        traceback: TracebackType | None,
    ) -> None:
        """Needs no release."""

    def serve(self, lock: FolderLock) -> None:
        """Needs no check."""

    def count(self) -> int:
        """One."""
        return 1

    def begin(self, task: Task) -> None:
        """Stores the task for ``ended``."""
        self._task = task

    def ended(self, progress: Progress) -> tuple[Task, Result]:
        """Runs the stored task."""
        task, self._task = self._task, None
        assert task is not None
        return task, task.result(progress.advance)
