"""Watch over a stream: what is wrong with its frames, told once and counted."""

from __future__ import annotations

import math
from collections import Counter, deque
from statistics import median

import numpy as np

from regkit.interfaces import TimedFrame
from regkit.observation import Frame
from regkit.system.notes import note
from regkit.tracking.live.reader import Arrived

GAP = 3.5
"""Two frames that are farther apart than this, in periods of the nominal rate, have a gap between
them: of the motion in it nothing is known."""

SLOW = 0.5
"""A stream is slow below this part of its nominal rate ..."""

SLOW_FRAMES = 10
"""... over so many frames."""

SPARSE = 101
"""Every so many pixels are compared first, since pictures that differ do so in most of them."""

MOST_DAMAGED = 100
"""After so many damaged frames in a row a stream counts as lost."""


class StreamWatch:
    """Watches the frames of a stream; each kind of fault is told when it first occurs.

    Faults in the order of their times do not end the tracking: a frame that adds nothing is passed
    over, and after a gap nothing is known of the motion.

    Args:
        name: Name of the stream, for messages.
        fps: Nominal frame rate [1/s].
    """

    def __init__(self, name: str, fps: float) -> None:
        self.faults: Counter[str] = Counter()
        """Numbers of faults by their names."""
        self._name = name
        self._period = 1.0 / fps
        self._last: TimedFrame | None = None
        self._number = 0
        self._intervals: deque[float] = deque(maxlen=SLOW_FRAMES)
        self._damaged = 0

    def damaged(self, arrived: Arrived, reason: str) -> None:
        """Notes a frame that cannot be read or registered."""
        self._damaged += 1
        self._tell("damaged", f"frame {arrived.number} is passed over: {reason}")

    def tracked(self) -> None:
        """Notes that a frame was tracked."""
        self._damaged = 0

    @property
    def is_lost(self) -> bool:
        """Whether too many frames in a row were damaged."""
        return self._damaged >= MOST_DAMAGED

    def stalled(self, seconds: float) -> None:
        """Notes that no frame has come for a while."""
        self._tell("stalled", f"no frame has come for {seconds:.0f} s; waiting")

    def is_repeated(self, number: int, frame: TimedFrame) -> bool:
        """Returns whether a frame is the last one again, in time and content; it adds nothing."""
        last = self._last
        if last is None or not len(frame.frame.points):
            return False
        if not _same_picture(last.frame, frame.frame):
            return False
        same = frame.time == last.time
        what = "the frame before it again" if same else "the picture of the frame before it"
        self._tell("repeated", f"frame {number} is {what}")
        return same

    def gap(self, number: int, frame: TimedFrame) -> float | None:
        """Returns the time [s] since the last frame in which the motion is unknown; None if none.

        A time that goes back is a gap of any length. What is wrong is noted.

        Args:
            number: Number of the frame.
            frame: A frame that is tracked.
        """
        last, self._last = self._last, frame
        since, self._number = number - self._number, number
        if last is None:
            return None
        self._compare_cameras(number, last.frame, frame.frame)
        step = frame.time - last.time
        if step < 0.0:
            self._tell("back in time", f"frame {number} is {-step:.3g} s before the last one")
            return math.inf
        if step == 0.0:
            self._tell("same time", f"frame {number} has the time of the last one")
            return None
        # Between two tracked frames of a camera others may have come, which were dropped.
        interval = step / max(since, 1)
        self._compare_rate(number, interval)
        if interval > GAP * self._period:
            self._tell("gaps", f"frame {number} comes {interval:.3g} s after the one before it")
        return step if step > GAP * self._period else None

    def _compare_cameras(self, number: int, before: Frame, after: Frame) -> None:
        sizes = [None if one.depth is None else one.depth.shape for one in (before, after)]
        if sizes[0] != sizes[1]:
            told = ["a cloud" if size is None else f"{size[1]}x{size[0]} pixels" for size in sizes]
            self._tell("other size", f"frame {number} has {told[1]}, the last one {told[0]}")
        elif before.camera != after.camera:
            self._tell("other camera", f"frame {number} has other intrinsics than the last one")

    def _compare_rate(self, number: int, interval: float) -> None:
        self._intervals.append(interval)
        # One gap alone does not make a slow stream.
        usual = median(self._intervals)
        if len(self._intervals) == SLOW_FRAMES and usual * SLOW > self._period:
            self._tell(
                "slow",
                f"at frame {number} the stream has {1.0 / usual:.2g} frames per second instead of "
                f"{1.0 / self._period:.3g}; fast motion may be lost",
            )

    def _tell(self, fault: str, message: str) -> None:
        self.faults[fault] += 1
        if self.faults[fault] == 1:
            note(message, place=self._name)


def _same_picture(one: Frame, other: Frame) -> bool:
    """Returns whether two frames hold the same data."""
    pair = (one.points, other.points)
    if one.depth is not None and other.depth is not None:
        pair = (one.depth, other.depth)
    if pair[0].shape != pair[1].shape:
        return False
    first, second = (array.ravel() for array in pair)
    sparse = np.array_equal(first[::SPARSE], second[::SPARSE], equal_nan=True)
    return sparse and np.array_equal(first, second, equal_nan=True)
