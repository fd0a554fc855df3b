"""Whose a results folder is while a run writes to it."""

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
"""The file that is locked; it is gone when the run has ended, and stale if it was killed."""


@dataclass(frozen=True)
class FolderLock:
    """A run's claim on its results folder.

    The operating system ends it with the process, so that a killed run never stands in the way.
    Workers, which may be elsewhere, read the claim: they write for nobody else.

    Attributes:
        folder: The results folder.
        run: A name that no other run has.
    """

    folder: Path
    run: str

    def stands(self) -> bool:
        """Whether the folder, as seen from here, is still the run's."""
        try:
            text = (self.folder / MARK).read_text(encoding="utf-8")
            return bool(json.loads(text)["run"] == self.run)
        except (OSError, ValueError, KeyError):
            return False


@contextmanager
def locked(folder: Path) -> Iterator[FolderLock]:
    """A results folder as this run's alone.

    It is made if it is not there, and then is gone again if nothing was written to it.

    Raises:
        ConfigError: If another run is writing there.
        DataError: If it cannot be written to.
    """
    lock, new = FolderLock(folder.absolute(), uuid4().hex), not folder.exists()
    with _told(folder):
        folder.mkdir(parents=True, exist_ok=True)
        descriptor = _lock_file(folder)
    try:
        claim = {"run": lock.run, "process": os.getpid(), "machine": platform.node()}
        with _told(folder):
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
def _told(folder: Path) -> Iterator[None]:
    """An error of the operating system as one that names the folder."""
    try:
        yield
    except OSError as error:
        raise DataError(
            f"cannot be written: {error.strerror or error}", place=str(folder)
        ) from None


def _lock_file(folder: Path) -> int:
    """An open descriptor of the mark, which nobody else has locked."""
    while True:
        descriptor = os.open(folder / MARK, os.O_RDWR | os.O_CREAT, 0o644)
        try:
            _lock(descriptor)
        except (BlockingIOError, PermissionError):
            os.close(descriptor)
            raise _occupied(folder) from None
        except OSError:
            # A file system without locks, say; nobody else is there.
            os.close(descriptor)
            raise
        # Its last holder may have removed the file between our opening and locking it.
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
        f"{who} is writing there; wait for its end, or choose another folder",
        place=str(folder),
    )


if sys.platform == "win32":
    import msvcrt

    def _lock(descriptor: int) -> None:
        # Windows locks ranges, and none may read a locked one: this byte is far behind the claim.
        os.lseek(descriptor, 1 << 20, os.SEEK_SET)
        msvcrt.locking(descriptor, msvcrt.LK_NBLCK, 1)
        os.lseek(descriptor, 0, os.SEEK_SET)

else:
    import fcntl

    def _lock(descriptor: int) -> None:
        fcntl.flock(descriptor, fcntl.LOCK_EX | fcntl.LOCK_NB)
