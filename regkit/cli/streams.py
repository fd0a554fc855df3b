"""Standard output and error of the command line, wherever they lead."""

from __future__ import annotations

import errno
import os
import sys
from collections.abc import Iterator
from contextlib import contextmanager, suppress
from typing import Any

from regkit.system.errors import DataError

_GONE = (errno.EPIPE, errno.EINVAL, errno.ECONNRESET)
"""Errors of a pipe that nobody reads; Windows reports an invalid argument."""


class _Stream:
    """A standard stream whose reader may go away, as in ``regkit plugins | head -1``.

    What is printed then is lost, and the command goes on to its own end and exit code. A full disk
    is an error on standard output; on standard error there is nowhere left to tell it.
    """

    def __init__(self, stream: Any, *, needed: bool) -> None:
        self._stream = stream
        self._needed = needed

    def write(self, text: str) -> int:
        self._tried(lambda: self._stream.write(text))
        return len(text)

    def flush(self) -> None:
        self._tried(self._stream.flush)

    def __getattr__(self, name: str) -> Any:
        return getattr(self._stream, name)

    def _tried(self, call: Any) -> None:
        try:
            call()
        except OSError as error:
            self._lead_nowhere()
            if self._needed and error.errno not in _GONE:
                raise DataError(
                    f"cannot be written: {error.strerror or error}", place="standard output"
                ) from None

    def _lead_nowhere(self) -> None:
        """Sends what is still buffered nowhere, so that no later flush fails."""
        with suppress(OSError, ValueError):
            nowhere = os.open(os.devnull, os.O_WRONLY)
            os.dup2(nowhere, self._stream.fileno())
            os.close(nowhere)


@contextmanager
def standard_streams() -> Iterator[None]:
    """Context manager: printing neither fails for a character nor for a reader that left.

    A terminal that cannot show a character shows its escape, such as ``\\xb0`` for a degree sign.
    """  # noqa: D301 - the escape is meant.
    former = sys.stdout, sys.stderr
    for name, needed in (("stdout", True), ("stderr", False)):
        stream = getattr(sys, name)
        if stream is not None:
            with suppress(AttributeError, ValueError):
                stream.reconfigure(errors="backslashreplace")
            setattr(sys, name, _Stream(stream, needed=needed))
    try:
        yield
    finally:
        sys.stdout, sys.stderr = former


def flush_output() -> None:
    """Writes what standard output still holds.

    Raises:
        DataError: If there is no room for it.
    """
    if sys.stdout is not None:
        sys.stdout.flush()
