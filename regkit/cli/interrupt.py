"""Ctrl-C in a long run: it is answered between two frames, where nothing is half done."""

from __future__ import annotations

import signal
from types import TracebackType

from regkit.cli.console import errors


class Interrupt:
    """A context that notes Ctrl-C; ``check`` answers it, and a second Ctrl-C ends at once.

    An exception in the middle of compiled code would reach the program as another error, and look
    like a fault of the recording. A process that was started with Ctrl-C ignored, as shells start
    what runs in the background, goes on ignoring it.
    """

    def __init__(self, answer: str = "stopping after this frame") -> None:
        """``answer`` is what is said at once."""
        self._answer = answer
        self._asked = False
        self._former = signal.getsignal(signal.SIGINT)
        # None is a handler that Python did not set, and cannot set again.
        self._heard = self._former not in (signal.SIG_IGN, None)

    def __enter__(self) -> Interrupt:
        """Note Ctrl-C from now on."""
        if self._heard:
            signal.signal(signal.SIGINT, self._note)
        return self

    def __exit__(
        self,
        kind: type[BaseException] | None,
        error: BaseException | None,
        traceback: TracebackType | None,
    ) -> None:
        """Leave Ctrl-C to who had it before."""
        if self._heard:
            signal.signal(signal.SIGINT, self._former)

    def check(self) -> None:
        """Raise what Ctrl-C would have raised.

        Raises:
            KeyboardInterrupt: If it was pressed.
        """
        if self._asked:
            raise KeyboardInterrupt

    def _note(self, *_: object) -> None:
        self._asked = True
        errors.print(f"{self._answer}; Ctrl-C again ends at once", highlight=False)
        signal.signal(signal.SIGINT, signal.default_int_handler)
