"""Workers of a crew: processes with a share of the samples each, or this process alone."""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Callable, Sequence
from functools import partial
from pathlib import Path
from typing import Any

from regkit.config.registry import plugin_files, run_plugin_file
from regkit.system.errors import RegkitError
from regkit.system.processes import broken_pool, deaf_children, pool_of_one


class Worker(ABC):
    """Runs one task after the other, always in the same process."""

    @abstractmethod
    def begin(self, task: Callable[..., Any], *arguments: Any) -> Callable[[], Any]:
        """Begins a task, and returns a function that waits for its result."""

    @abstractmethod
    def end(self) -> None:
        """Ends the worker at once."""


class OtherProcess(Worker):
    """A process, which starts with its first task."""

    def __init__(self) -> None:
        self._pool = pool_of_one(partial(_prepare, plugin_files()))

    def begin(self, task: Callable[..., Any], *arguments: Any) -> Callable[[], Any]:
        """Sends a task to the process."""
        with deaf_children():
            future = self._pool.submit(task, *arguments)
        return partial(_result, future)

    def end(self) -> None:
        """Kills the process."""
        self._pool.shutdown(wait=True, kill_workers=True)


class ThisProcess(Worker):
    """This process, in which a task runs when its result is asked for."""

    def __init__(self, forget: Callable[[], None]) -> None:
        self._forget = forget

    def begin(self, task: Callable[..., Any], *arguments: Any) -> Callable[[], Any]:
        """Keeps the task."""
        return partial(task, *arguments)

    def end(self) -> None:
        """Lets go of what tasks have kept."""
        self._forget()


def _prepare(files: Sequence[Path]) -> None:
    """Runs on a worker: makes the plug-ins of files available, before a task names them."""
    for file in files:
        run_plugin_file(file)


def _result(future: Any) -> Any:
    try:
        return future.result()
    except broken_pool():
        raise RegkitError(
            "a process died, perhaps for lack of memory; use fewer processes"
        ) from None
