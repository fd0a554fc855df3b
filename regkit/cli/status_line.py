"""One line on the state of a live track: on a terminal always, elsewhere once a minute."""

from __future__ import annotations

import math
import time
from collections.abc import Callable
from typing import TYPE_CHECKING, Any

from regkit.api.live_pose import LivePose
from regkit.api.live_track import LiveTrack
from regkit.cli.console import errors
from regkit.system.closing import Closing

if TYPE_CHECKING:
    from rich.console import Console

EVERY = 60.0
"""Time between two lines in a pipe [s]."""

SHOWN_EVERY = 0.25
"""Time between two changes of the line on a terminal [s]."""

SMOOTH = 0.05
"""Weight of the last frame in the mean time of a frame."""


class StatusLine(Closing):
    """The state of a live track: rate, latency, inliers, verdict, dropped frames.

    Args:
        track: The track.
        console: Where the line is shown.
        clock: Returns the time [s].
    """

    def __init__(
        self,
        track: LiveTrack,
        console: Console = errors,
        clock: Callable[[], float] = time.perf_counter,
    ) -> None:
        self._track = track
        self._console = console
        self._clock = clock
        self._every = SHOWN_EVERY if console.is_terminal else EVERY
        self._told = self._last = clock()
        self._period = math.nan
        self._latency = math.nan
        self._line: Any = None

    def close(self) -> None:
        """Removes the line."""
        if self._line is not None:
            self._line.stop()
            self._line = None

    def add(self, pose: LivePose) -> str:
        """Counts a frame, and returns the line."""
        now = self._clock()
        self._period = _mean(self._period, now - self._last)
        self._latency = _mean(self._latency, pose.latency)
        self._last = now
        text = self._text(pose)
        if now - self._told >= self._every or (self._line is None and self._console.is_terminal):
            self._told = now
            self._show(text)
        return text

    def _text(self, pose: LivePose) -> str:
        length = self._track.stream.length
        parts = [f"frame {pose.number}" if length is None else f"frame {pose.number} of {length}"]
        if self._period > 0.0:
            parts.append(f"{1.0 / self._period:.0f} frames/s")
        if self._track.is_live:
            parts.append(f"latency {1000.0 * self._latency:.0f} ms")
        if math.isfinite(pose.inlier_share):
            parts.append(f"{100.0 * pose.inlier_share:.0f} % inliers")
        parts.append("no body in sight" if pose.observation is None else str(pose.verdict))
        if self._track.dropped:
            parts.append(f"{self._track.dropped} dropped")
        return ", ".join(parts)

    def _show(self, text: str) -> None:
        if not self._console.is_terminal:
            self._console.print(text)
            return
        if self._line is None:
            self._line = self._console.status(text)
            self._line.start()
        self._line.update(text)


def _mean(mean: float, value: float) -> float:
    return value if math.isnan(mean) else mean + SMOOTH * (value - mean)
