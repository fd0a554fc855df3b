"""Ctrl-C in a long run, handled between two frames, where no work is half done."""

from __future__ import annotations

import signal
from types import TracebackType

from regkit.cli.console import errors


class Interrupt:
    """Context manager that records Ctrl-C for ``check``; a second Ctrl-C ends the run at once.

    An exception inside compiled code would reach the program as another error and look like a
    fault of the recording. A process that started with Ctrl-C ignored, as shells start background
    jobs, keeps ignoring it.
    """

    def __init__(self, answer: str = "stopping after this frame") -> None:
        """``answer`` is the message printed on the first Ctrl-C."""
        self._answer = answer
        self._pressed = False
        self._former = signal.getsignal(signal.SIGINT)
        # Python reports None for a handler that it did not install and cannot restore.
        self._heard = self._former not in (signal.SIG_IGN, None)

    def __enter__(self) -> Interrupt:
        """Records Ctrl-C from now on."""
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
        if self._heard:
            signal.signal(signal.SIGINT, self._former)

    def check(self) -> None:
        """Raises KeyboardInterrupt if Ctrl-C was pressed.

        Raises:
            KeyboardInterrupt: If it was pressed.
        """
        if self._pressed:
            raise KeyboardInterrupt

    def _note(self, *_: object) -> None:
        self._pressed = True
        errors.print(f"{self._answer}; press Ctrl-C again to end at once", highlight=False)
        signal.signal(signal.SIGINT, signal.default_int_handler)
