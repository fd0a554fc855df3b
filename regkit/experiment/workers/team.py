"""Who does the tasks of a run: this process, or workers that this module does not know."""

from __future__ import annotations

from abc import ABC, abstractmethod
from contextlib import AbstractContextManager
from types import TracebackType

from regkit.experiment.lock import FolderLock
from regkit.experiment.progress import Progress
from regkit.experiment.task import Result, Task

TRIES = 3
"""So often a task may cost a worker its life before it counts as failed."""


class Team(ABC):
    """Workers that are there for one run."""

    @abstractmethod
    def serve(self, lock: FolderLock) -> None:
        """Work for the run that holds a results folder.

        Raises:
            RegkitError: If they cannot.
        """

    @abstractmethod
    def count(self) -> int:
        """How many tasks can be in hand at once, as things stand."""

    @abstractmethod
    def begin(self, task: Task) -> None:
        """Give a task to a worker that has none."""

    @abstractmethod
    def ended(self, progress: Progress) -> tuple[Task, Result]:
        """Wait for the next task that ends; meanwhile who watches is asked now and then.

        Raises:
            RegkitError: If all workers are lost.
        """


class Workers(ABC):
    """A choice of who does the tasks."""

    @abstractmethod
    def team(self) -> AbstractContextManager[Team]:
        """Workers for a run, that leave when the context is left.

        Raises:
            RegkitError: If they cannot be had.
        """

    @property
    @abstractmethod
    def described(self) -> str:
        """How ``environment.json`` names them."""

    @property
    @abstractmethod
    def remote(self) -> bool:
        """Whether tasks are done in other processes."""


class ThisProcess(Workers, Team):
    """No workers: one task after the other is done here."""

    def __init__(self) -> None:
        self._task: Task | None = None

    @property
    def described(self) -> str:
        """This process."""
        return "1 process"

    @property
    def remote(self) -> bool:
        """Here."""
        return False

    def team(self) -> AbstractContextManager[Team]:
        """This very object."""
        return self

    def __enter__(self) -> Team:
        """Nothing to prepare."""
        return self

    def __exit__(
        self,
        kind: type[BaseException] | None,
        error: BaseException | None,
        traceback: TracebackType | None,
    ) -> None:
        """Nothing to leave."""

    def serve(self, lock: FolderLock) -> None:
        """Nothing stands in the way."""

    def count(self) -> int:
        """One."""
        return 1

    def begin(self, task: Task) -> None:
        """Note it."""
        self._task = task

    def ended(self, progress: Progress) -> tuple[Task, Result]:
        """Do it."""
        task, self._task = self._task, None
        assert task is not None
        return task, task.result(progress.advance)
