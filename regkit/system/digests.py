"""Digests of files and data; a file is read only if its size or times are new."""

from __future__ import annotations

import hashlib
import json
import os
from functools import lru_cache
from pathlib import Path
from typing import Any, NamedTuple

REMEMBERED = 1 << 15
"""Number of files whose digests a process remembers."""


class Stamp(NamedTuple):
    """What tells without reading that a file is unchanged.

    Attributes:
        size: Size [bytes].
        modified: Time of the last change of the content [ns].
        changed: Time of the last change of the entry [ns]; programs that keep ``modified`` while
            they change the content cannot keep this.
    """

    size: int
    modified: int
    changed: int

    @classmethod
    def of(cls, path: Path | str) -> Stamp:
        """Returns the stamp of a file.

        Raises:
            OSError: If there is no such file.
        """
        found = os.stat(path)  # noqa: PTH116 - of many thousand files, as text.
        return cls(found.st_size, found.st_mtime_ns, found.st_ctime_ns)


def file_digest(path: Path | str, stamp: Stamp | None = None) -> str:
    """Returns the SHA-256 of a file's content.

    Args:
        path: The file.
        stamp: Its stamp, taken before; with one, the digest is remembered.

    Raises:
        OSError: If the file cannot be read.
    """
    return _digest(str(path)) if stamp is None else _remembered(str(path), stamp)


def data_digest(data: Any) -> str:
    """Returns the SHA-256 of JSON data, regardless of the order of keys."""
    text = json.dumps(data, sort_keys=True, separators=(",", ":"))
    return hashlib.sha256(text.encode()).hexdigest()


@lru_cache(maxsize=REMEMBERED)
def _remembered(path: str, stamp: Stamp) -> str:
    return _digest(path)


def _digest(path: str) -> str:
    with open(path, "rb") as stream:  # noqa: PTH123 - as above.
        return hashlib.file_digest(stream, "sha256").hexdigest()
