"""Ctrl-C: a command ends within two seconds, with exit code 130 and without a traceback."""

from __future__ import annotations

import os
import signal
import sys
from threading import Timer
from types import TracebackType
from typing import NoReturn

from regkit.cli.console import errors
from regkit.cli.exit_codes import INTERRUPTED
from regkit.system.plugin_code import Ended

PATIENCE = 1.5
"""Time [s] after Ctrl-C at which a command that still runs is ended."""


class Interrupt:
    """Context manager that ends a command on Ctrl-C, or lets a run end between two frames.

    An exception inside compiled code would reach the program as another error and look like a
    fault of the recording. So a run only records Ctrl-C, and asks by ``check``. In both cases what
    does not end by itself is ended after ``PATIENCE``: files are written atomically, and workers
    end with their parent, so that nothing is lost but the current track.

    A process that started with Ctrl-C ignored, as shells start background jobs, keeps ignoring it.
    """

    def __init__(self, answer: str = "interrupted", *, checked: bool = False) -> None:
        """Prepares the handler.

        Args:
            answer: Message printed on Ctrl-C.
            checked: Whether Ctrl-C is only recorded for ``check``; a second one ends at once.
        """
        self._answer = answer
        self._checked = checked
        self.pressed = False
        self.last_words: str | None = None
        """Printed if the command does not end by itself."""
        self._timer: Timer | None = None
        self._former = signal.getsignal(signal.SIGINT)
        # Python reports None for a handler that it did not install and cannot restore.
        self._heard = self._former not in (signal.SIG_IGN, None)

    def __enter__(self) -> Interrupt:
        """Listens to Ctrl-C from now on."""
        if self._heard:
            signal.signal(signal.SIGINT, self._note)
        return self

    def __exit__(
        self,
        kind: type[BaseException] | None,
        error: BaseException | None,
        traceback: TracebackType | None,
    ) -> None:
        """Restores the previous handler."""
        if self._timer is not None:
            self._timer.cancel()
        if self._heard:
            signal.signal(signal.SIGINT, self._former)

    def check(self) -> None:
        """Raises KeyboardInterrupt if Ctrl-C was pressed.

        Raises:
            KeyboardInterrupt: If it was pressed.
        """
        if self.pressed:
            raise KeyboardInterrupt

    def take_time(self) -> None:
        """Lets the command end in its own time; another Ctrl-C still ends it at once."""
        if self._timer is not None:
            self._timer.cancel()

    def _note(self, *_: object) -> None:
        self.pressed = True
        signal.signal(signal.SIGINT, _leave)
        self._timer = Timer(PATIENCE, self._end)
        self._timer.daemon = True
        self._timer.start()
        more = "; press Ctrl-C again to end at once" if self._checked else ""
        errors.print(self._answer + more)
        if not self._checked:
            _leave()

    def _end(self) -> None:
        if self.last_words is not None:
            errors.print(self.last_words)
        sys.stdout.flush()
        os._exit(INTERRUPTED)


def _leave(*_: object) -> NoReturn:
    # A KeyboardInterrupt in code that is compiled from a string, as of a dataclass, would make
    # Python end by the signal and not by the exit code, even where it is caught.
    raise Ended(INTERRUPTED)
