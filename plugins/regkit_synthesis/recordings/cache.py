"""The content-addressed cache of rendered recordings."""

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
"""The file of an entry with the SHA-256 of all others."""

_ATTEMPTS = 5
"""Number of attempts to put an entry in place while other processes do the same."""

_SCRATCH = ".new-"
"""Prefix of the folders in which entries are written."""

_ABANDONED = 86400.0
"""Age from which such a folder belongs to a killed process; writing takes seconds [s]."""


@dataclass(frozen=True)
class RecordingCache:
    """A folder of rendered recordings; missing or damaged ones are rendered again.

    Attributes:
        folder: The folder.
    """

    folder: Path

    @classmethod
    def of_user(cls) -> RecordingCache:
        """Returns the cache in the user's cache folder."""
        return cls(cache_folder() / "synthetic")

    def entry(self, key: str, make: Callable[[], DepthRecording]) -> Path:
        """Returns the folder of a recording, and renders it if it is missing.

        Several processes may request the same recording; each gets a complete one.

        Args:
            key: Digest of everything that the recording depends on.
            make: Function that renders the recording.

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
    """Renames ``new`` to ``entry`` unless another process was faster; replaces a damaged entry."""
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
    """Removes the folders of killed processes; other processes may do the same concurrently."""
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
    """Returns whether a folder is complete and unchanged."""
    try:
        sums = json.loads((folder / _CHECKSUMS).read_text(encoding="utf-8"))
        return bool(sums == {name: _checksum(folder / name) for name in _files(folder)})
    except (OSError, ValueError):
        return False


def _files(folder: Path) -> list[str]:
    """Returns all files of a folder, recursively, except the checksums."""
    files = [path for path in folder.rglob("*") if path.is_file() and path.name != _CHECKSUMS]
    return sorted(path.relative_to(folder).as_posix() for path in files)


def _checksum(path: Path) -> str:
    return hashlib.sha256(path.read_bytes()).hexdigest()
