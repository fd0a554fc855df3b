"""How a stream is tracked."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

from regkit.body import Body
from regkit.interfaces import Recording, Registrar, Start, TimedFrame, Tracker
from regkit.tracking.rows import Rows
from regkit.tracking.session import Session

OPENING = 2.0
"""Duration of a camera's opening [s], for which a person waits."""

RECORDED_OPENING = 10.0
"""Duration of a recording's opening [s], which shows more of the body and of what moves."""


@dataclass(frozen=True)
class LiveSetup:
    """How a stream is tracked.

    Attributes:
        session: Returns the session of a recording with the stream's first frames.
        bind: Binds the method to the body that was found.
        tracker: Tracker from frame to frame.
        rows: Returns where the values of a track are kept; in memory by default.
        opening: Duration of the opening [s]; for None that of a camera or of a recording.
        every_frame: Whether every frame of a camera is tracked, however late.
        realtime: Whether a recording is played at its own pace after its opening was seen.
        tap: Called with every frame of the track when it is read, in another thread.
        check: Called between two frames, and while none comes; what it raises ends the tracking.
    """

    session: Callable[[Recording], Session]
    bind: Callable[[Body], Registrar]
    tracker: Tracker
    rows: Callable[[Start], Rows] | None = None
    opening: float | None = None
    every_frame: bool = False
    realtime: bool = False
    tap: Callable[[TimedFrame], None] | None = None
    check: Callable[[], None] = lambda: None

    def opening_of(self, *, live: bool) -> float:
        """Returns the duration of the opening [s].

        Args:
            live: Whether the stream is a camera's.
        """
        return self.opening or (OPENING if live else RECORDED_OPENING)
