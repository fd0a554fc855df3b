"""Rendered recordings on disk, each kept under a name that its content decides."""

from __future__ import annotations

import hashlib
import json
import shutil
import tempfile
import time
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path

from regkit.system.cache import VARIABLE, cache_folder
from regkit.system.errors import DataError
from regkit_synthesis.recordings.recording import DepthRecording

_CHECKSUMS = "checksums.json"
"""The file of an entry that tells the SHA-256 of all others."""

_ATTEMPTS = 5
"""How often an entry is put in place while other processes do the same."""

_SCRATCH = ".new-"
"""How the names of folders begin in which entries are written."""

_ABANDONED = 86400.0
"""Such a folder as old as this is a killed process's, for writing takes seconds [s]."""


@dataclass(frozen=True)
class RecordingCache:
    """Folders of depth recordings, any of which may be lost or damaged: it is made again.

    Attributes:
        folder: Where they are.
    """

    folder: Path

    @classmethod
    def of_user(cls) -> RecordingCache:
        """The one in the user's cache folder."""
        return cls(cache_folder() / "synthetic")

    def entry(self, key: str, make: Callable[[], DepthRecording]) -> Path:
        """The folder of a recording, written by whoever needs it first.

        Several processes may ask for the same one; each finds it whole.

        Args:
            key: Stands for all that the recording depends on.
            make: Makes it.

        Raises:
            DataError: If the cache cannot be written.
        """
        entry = self.folder / key
        if _is_intact(entry):
            return entry
        recording = make()
        try:
            self.folder.mkdir(parents=True, exist_ok=True)
            _remove_abandoned(self.folder)
            with tempfile.TemporaryDirectory(dir=self.folder, prefix=_SCRATCH) as scratch:
                new = Path(scratch) / key
                recording.write_into(new)
                _write_checksums(new)
                _put(new, entry, Path(scratch))
        except OSError as error:
            raise DataError(
                f"the cache cannot be written: {error.strerror or error}; the environment variable "
                f"{VARIABLE} can name another folder",
                place=str(self.folder),
            ) from None
        return entry


def _put(new: Path, entry: Path, scratch: Path) -> None:
    """Rename ``new`` to ``entry``, unless another process was faster; what is damaged gives way."""
    for attempt in range(_ATTEMPTS):
        try:
            new.rename(entry)
        except OSError:
            if attempt == _ATTEMPTS - 1 or not entry.exists():
                raise
            if _is_intact(entry):
                return
            try:
                entry.rename(scratch / f"damaged{attempt}")
            except FileNotFoundError:
                continue  # Another process has taken it away.
        else:
            return


def _remove_abandoned(folder: Path) -> None:
    """Remove what processes that were killed while they wrote have left; others may do the same."""
    for scratch in folder.glob(f"{_SCRATCH}*"):
        try:
            abandoned = time.time() - scratch.stat().st_mtime > _ABANDONED
        except FileNotFoundError:
            continue  # Its process, or another one that removes it, was faster.
        if abandoned:
            shutil.rmtree(scratch, ignore_errors=True)


def _write_checksums(folder: Path) -> None:
    sums = {name: _checksum(folder / name) for name in _files(folder)}
    (folder / _CHECKSUMS).write_text(json.dumps(sums, indent=0), encoding="utf-8")


def _is_intact(folder: Path) -> bool:
    """Whether a folder holds all that was written, unchanged."""
    try:
        sums = json.loads((folder / _CHECKSUMS).read_text(encoding="utf-8"))
        return bool(sums == {name: _checksum(folder / name) for name in _files(folder)})
    except (OSError, ValueError):
        return False


def _files(folder: Path) -> list[str]:
    """The files of a folder and of those in it, but for the checksums."""
    files = [path for path in folder.rglob("*") if path.is_file() and path.name != _CHECKSUMS]
    return sorted(path.relative_to(folder).as_posix() for path in files)


def _checksum(path: Path) -> str:
    return hashlib.sha256(path.read_bytes()).hexdigest()
