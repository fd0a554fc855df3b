"""Exclusive use of a results folder by one run."""

from __future__ import annotations

import json
import os
import platform
import sys
from collections.abc import Iterator
from contextlib import contextmanager, suppress
from dataclasses import dataclass
from pathlib import Path
from uuid import uuid4

from regkit.system.errors import ConfigError, DataError

MARK = ".running"
"""The locked file; removed at the end of a run, stale if the run was killed."""


@dataclass(frozen=True)
class FolderLock:
    """A run's lock on its results folder.

    The operating system releases it with the process, so that a killed run never blocks others.
    Workers, possibly on other machines, read it to stop when their run is over.

    Attributes:
        folder: The results folder.
        run: Unique name of the run.
    """

    folder: Path
    run: str

    def stands(self) -> bool:
        """Whether the run still holds the folder, as seen by this process."""
        try:
            text = (self.folder / MARK).read_text(encoding="utf-8")
            return bool(json.loads(text)["run"] == self.run)
        except (OSError, ValueError, KeyError):
            return False


@contextmanager
def locked(folder: Path) -> Iterator[FolderLock]:
    """Context manager that locks a results folder for this run.

    A missing folder is created, and removed again if nothing was written to it.

    Raises:
        ConfigError: If another run holds the folder.
        DataError: If the folder is not writable.
    """
    lock, new = FolderLock(folder.absolute(), uuid4().hex), not folder.exists()
    with _naming(folder):
        folder.mkdir(parents=True, exist_ok=True)
        descriptor = _lock_file(folder)
    try:
        claim = {"run": lock.run, "process": os.getpid(), "machine": platform.node()}
        with _naming(folder):
            os.truncate(descriptor, 0)
            os.write(descriptor, json.dumps(claim).encode())
        yield lock
    finally:
        with suppress(OSError):
            (folder / MARK).unlink()
        os.close(descriptor)
        if new:
            with suppress(OSError):
                folder.rmdir()


@contextmanager
def _naming(folder: Path) -> Iterator[None]:
    """Context manager that turns errors of the operating system into ones that name the folder."""
    try:
        yield
    except OSError as error:
        raise DataError(
            f"cannot be written: {error.strerror or error}", place=str(folder)
        ) from None


def _lock_file(folder: Path) -> int:
    """Returns an open descriptor of the locked file."""
    while True:
        descriptor = os.open(folder / MARK, os.O_RDWR | os.O_CREAT, 0o644)
        try:
            _lock(descriptor)
        except (BlockingIOError, PermissionError):
            os.close(descriptor)
            raise _occupied(folder) from None
        except OSError:
            # For example, the file system has no locks.
            os.close(descriptor)
            raise
        # The previous holder may have removed the file between opening and locking it here.
        with suppress(OSError):
            if os.path.samestat(os.fstat(descriptor), (folder / MARK).stat()):
                return descriptor
        os.close(descriptor)


def _occupied(folder: Path) -> ConfigError:
    who = "another run"
    with suppress(OSError, ValueError, KeyError):
        claim = json.loads((folder / MARK).read_text(encoding="utf-8"))
        who += f" (process {claim['process']} on {claim['machine']})"
    return ConfigError(
        f"{who} writes to this folder; wait until it ends, or choose another folder",
        place=str(folder),
    )


if sys.platform == "win32":
    import msvcrt

    def _lock(descriptor: int) -> None:
        # Windows locks ranges and forbids reading them: lock a byte far behind the content.
        os.lseek(descriptor, 1 << 20, os.SEEK_SET)
        msvcrt.locking(descriptor, msvcrt.LK_NBLCK, 1)
        os.lseek(descriptor, 0, os.SEEK_SET)

else:
    import fcntl

    def _lock(descriptor: int) -> None:
        fcntl.flock(descriptor, fcntl.LOCK_EX | fcntl.LOCK_NB)
