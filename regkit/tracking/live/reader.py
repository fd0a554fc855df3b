"""Reading of a stream in a thread of its own, beside the tracking."""

from __future__ import annotations

import time
from collections import deque
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from threading import Condition, Thread

from regkit.interfaces import Stream, TimedFrame
from regkit.system.errors import DataError, RegkitError

AHEAD = 4
"""Number of frames of a recording that are read ahead."""

BUFFERED = 300
"""Number of a camera's frames that may wait if all are to be tracked; what is later is dropped."""


@dataclass(frozen=True)
class Arrived:
    """A frame as it comes from a stream.

    Attributes:
        number: Its number in the stream, from 0.
        frame: The frame and its time; None if it is damaged.
        error: What is wrong with a damaged frame.
        at: When it arrived, on the clock of ``time.perf_counter`` [s].
    """

    number: int
    frame: TimedFrame | None
    error: DataError | None
    at: float


class FrameReader:
    """Reads the frames of a stream in the background, and holds those that wait.

    Of a camera the newest frame wins: one that waits when the next arrives is dropped, and
    counted. A recording waits for the tracking instead.

    Args:
        stream: The stream, which the reader closes at the end.
        every_frame: Whether a camera's frames wait for the tracking too, up to ``BUFFERED``.
        tap: Called with every frame, also those that are dropped, in the thread that reads.
    """

    def __init__(
        self,
        stream: Stream,
        *,
        every_frame: bool = False,
        tap: Callable[[TimedFrame], None] | None = None,
    ) -> None:
        self.stream = stream
        self._tap = tap
        self.dropped = 0
        """Number of frames that were not tracked because newer ones had arrived."""
        self._limit = (BUFFERED if every_frame else 1) if stream.live else AHEAD
        self._keeps_newest = stream.live and not every_frame
        self._waiting: deque[Arrived] = deque()
        self._changed = Condition()
        self._over = self._closed = False
        self._failure: BaseException | None = None
        Thread(target=self._run, daemon=True, name=f"reading {stream.name}").start()

    def next(self, timeout: float) -> Arrived | None:
        """Returns the next frame; None if none arrives in time, or at the end.

        Args:
            timeout: Longest wait [s].

        Raises:
            RegkitError: If the stream yields no further frame although it has not ended.
        """
        with self._changed:
            self._changed.wait_for(lambda: self._waiting or self._over, timeout)
            if self._waiting:
                arrived = self._waiting.popleft()
                self._changed.notify_all()
                return arrived
            if self._failure is not None:
                raise self._failure
            return None

    @property
    def ended(self) -> bool:
        """Whether the stream has ended and no frame waits."""
        with self._changed:
            return self._over and not self._waiting and self._failure is None

    def close(self) -> None:
        """Ends the reading."""
        with self._changed:
            self._closed = True
            self._changed.notify_all()

    def _run(self) -> None:
        try:
            for arrived in _frames(self.stream):
                if self._tap is not None and arrived.frame is not None:
                    self._tap(arrived.frame)
                if not self._hold(arrived):
                    break
        except RegkitError as error:
            self._failure = error.at(self.stream.name)
        # Whatever else happens in this thread belongs to whoever waits for the frame.
        except BaseException as error:
            self._failure = error
        finally:
            try:
                self.stream.close()
            except Exception as error:
                self._failure = self._failure or error
            self._end()

    def _end(self) -> None:
        with self._changed:
            self._over = True
            self._changed.notify_all()

    def _hold(self, arrived: Arrived) -> bool:
        """Holds a frame until it is taken, and returns whether to go on."""
        with self._changed:
            if self.stream.live:
                if len(self._waiting) >= self._limit:
                    self.dropped += 1
                    if not self._keeps_newest:
                        return not self._closed
                    self._waiting.popleft()
            else:
                self._changed.wait_for(lambda: self._closed or len(self._waiting) < self._limit)
            self._waiting.append(arrived)
            self._changed.notify_all()
            return not self._closed


def _frames(stream: Stream) -> Iterator[Arrived]:
    """Yields all frames of a stream, damaged ones too."""
    number = 0
    while True:
        try:
            frame = stream.read()
        except DataError as error:
            yield Arrived(number, None, error, time.perf_counter())
        else:
            if frame is None:
                return
            yield Arrived(number, frame, None, time.perf_counter())
        number += 1
