"""The serialised form of a task: plain configuration data, without Python objects."""

from __future__ import annotations

import time
from dataclasses import dataclass
from functools import lru_cache
from pathlib import Path
from threading import Lock
from typing import Any

from regkit import __version__
from regkit.config.document import Document
from regkit.config.plugin import plugins_in
from regkit.config.registry import from_file, plugin_files, run_plugin_file
from regkit.experiment.experiment import Experiment
from regkit.experiment.lock import FolderLock
from regkit.experiment.resolved import resolved
from regkit.experiment.task import Result, Task
from regkit.system.digests import file_digest
from regkit.system.errors import ConfigError, DataError, DependencyError, RegkitError
from regkit.system.notes import collected_notes, tell_again
from regkit.system.plugin_code import plugin_code

CHECKED_EVERY = 1.0
"""Interval [s] at which a worker checks that the run still holds its folder."""

_ALONE = Lock()
"""Makes a worker with several threads run one task at a time: the last bits of results depend on
the number of threads of matrix products, which is one setting for the whole process."""


@dataclass(frozen=True)
class Packed:
    """A task in a form that another process can read.

    Attributes:
        config: The experiment as JSON.
        plugins: Plug-in files to run first.
        lock: Lock of the run that sent the task.
        version: Version of regkit in the run.
        folder, recording, method, setting: As in the task.
    """

    config: dict[str, Any]
    plugins: tuple[Path, ...]
    lock: FolderLock
    version: str
    folder: Path
    recording: str
    method: str | None
    setting: str

    @classmethod
    def of(cls, task: Task, lock: FolderLock) -> Packed:
        """Returns the serialised form of a task."""
        return cls(
            resolved(task.experiment),
            plugin_files(),
            lock,
            __version__,
            task.folder.absolute(),
            task.recording,
            task.method,
            task.setting,
        )

    def task(self) -> Task:
        """Returns the task.

        Raises:
            RegkitError: If this worker cannot run it.
        """
        check_worker(self.lock, self.version)
        for path in self.plugins:
            if not path.is_file():
                raise DataError("the worker does not see this file", place=str(path))
        _run_files(tuple((path, file_digest(path)) for path in self.plugins))
        experiment = Document(self.config, {(): "on a worker"}).validated(Experiment)
        return Task(experiment, self.folder, self.recording, self.method, self.setting)


@dataclass(frozen=True)
class Performed:
    """A task that a worker has run.

    Attributes:
        result: Its result.
        notes: What the worker would have told: several workers find the same.
    """

    result: Result
    notes: tuple[str, ...]

    def told(self) -> Result:
        """Returns the result, and tells the notes that the run has not told before."""
        tell_again(self.notes)
        return self.result


def performed(packed: Packed) -> Performed:
    """Runs a task on a worker; errors of any kind become its result."""
    with _ALONE, collected_notes() as notes:
        result = _result(packed)
        return Performed(result, tuple(notes))


def _result(packed: Packed) -> Result:
    try:
        with plugin_code("a plug-in"):
            task = packed.task()
    except RegkitError as error:
        return error
    try:
        return task.result(_Wanted(packed.lock).check)
    except _NotWanted:
        return DataError("the run of this task is over")


def check_worker(lock: FolderLock, version: str) -> None:
    """Checks that this worker can serve a run.

    Raises:
        DependencyError: If it has another version of regkit.
        DataError: If it cannot see the results folder.
    """
    if version != __version__:
        raise DependencyError(f"the worker has regkit {__version__}, and the run has {version}")
    if not lock.stands():
        raise DataError(
            "the worker does not see the results folder; it must be on a file system that all "
            "machines share, under the same path",
            place=str(lock.folder),
        )


def check_shared(experiment: Experiment) -> None:
    """Checks that workers can find all plug-ins of an experiment.

    Raises:
        ConfigError: If one exists in this process only.
    """
    for _, plugin in plugins_in(experiment):
        origin = type(plugin).available().get(plugin.kind)
        installed = origin is not None and not isinstance(origin, type)
        if not installed and not from_file(type(plugin)):
            raise ConfigError(
                f"the plug-in '{plugin.kind}' was registered in this process, and workers do not "
                "know it; move it to a plug-in file or an installed package, or run without workers"
            )


@lru_cache(maxsize=1)
def _run_files(files: tuple[tuple[Path, str], ...]) -> None:
    """Runs plug-in files, unless this worker ran the same ones last."""
    for path, _ in files:
        run_plugin_file(path)


class _NotWanted(KeyboardInterrupt):
    """The run is over; an interrupt, so that no error handler catches it."""


class _Wanted:
    """Checks now and then that the run still holds its folder."""

    def __init__(self, lock: FolderLock) -> None:
        self._lock = lock
        self._next = time.monotonic() + CHECKED_EVERY

    def check(self) -> None:
        """Raises ``_NotWanted`` if the run was killed or interrupted."""
        if time.monotonic() < self._next:
            return
        self._next = time.monotonic() + CHECKED_EVERY
        if not self._lock.stands():
            raise _NotWanted
