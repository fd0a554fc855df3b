"""The sample walk without an end, as a source: ``walk:COUNT`` with the faults of real streams.

It is a plug-in file for ``regkit track --plugin``.
"""

from __future__ import annotations

import time
from collections.abc import Iterator
from dataclasses import replace
from pathlib import Path
from typing import Any, ClassVar, Literal

import numpy as np

from regkit.config.plugin import register
from regkit.interfaces import Source, Stream, TimedFrame
from regkit.observation import Frame
from regkit.system.errors import DataError

WALK = Path(__file__).parent.parent / "docs" / "examples" / "data" / "human_walk"
FPS = 30.0

EVERY = 1_000
"""There is one fault in so many frames, each kind in turn."""

STALL = 2.5
"""Time for which the stream stalls, once [s]."""

SLOW, SLOW_PERIOD = 15, 0.5
"""Number of frames of which two come in a second, and the time between them [s]."""

Script = Iterator[TimedFrame | DataError]


class WalkStream(Stream):
    """The walk, forth and back, as often as needed; read once.

    Args:
        length: Number of frames.
        live: Whether the frames come at their times.
        faulty: Whether there are faults between them.
    """

    name, fps = "walk", FPS

    def __init__(self, length: int, *, live: bool, faulty: bool) -> None:
        self.length, self.live = length, live
        self._script: Script = faults(walk(length)) if faulty else walk(length)
        self._begun: float | None = None

    def read(self) -> TimedFrame | None:
        """Returns the next frame, at its time if it is live.

        Raises:
            DataError: If a fault is due.
        """
        frame = next(self._script, None)
        if isinstance(frame, DataError):
            raise frame
        if self.live and frame is not None:
            self._begun = time.perf_counter() if self._begun is None else self._begun
            time.sleep(max(self._begun + frame.time - time.perf_counter(), 0.0))
        return frame


@register
class Walk(Source):
    """The walk with faults, ``walk:COUNT``."""

    kind: Literal["walk"] = "walk"

    scheme: ClassVar[str] = "walk"

    count: int
    """Number of frames."""

    @classmethod
    def fields_of(cls, address: str) -> dict[str, Any]:
        """Returns the number of frames in an address."""
        return {"count": int(address)}

    def open(self) -> WalkStream:
        """Opens the walk at its first frame."""
        return WalkStream(self.count, live=False, faulty=True)


def walk(length: int) -> Iterator[TimedFrame]:
    """Yields frames of the walk, forth and back."""
    with Source.at(WALK).open() as stream:
        forth = [one.frame for one in stream]
    cycle = [*forth, *forth[-2:0:-1]]
    for number in range(length):
        yield TimedFrame(cycle[number % len(cycle)], number / FPS)


def faults(frames: Iterator[TimedFrame]) -> Script:
    """Yields frames with a fault now and then; the last one is cut short.

    Frames are damaged, come again, go back in time, come late, have half the resolution, come
    slowly for a while, and stall once.
    """
    late, slow, stalled = 0.0, 0, False
    last: TimedFrame | None = None
    for number, frame in enumerate(frames):
        kind = number // EVERY % 7 if number % EVERY == EVERY // 2 else None
        if kind == 0:
            yield DataError("cut short")
            continue
        if kind == 1 and last is not None:
            yield last
        elif kind == 2:
            late -= 5.0
        elif kind == 3:
            late += 10.0
        elif kind == 4:
            frame = replace(frame, frame=halved(frame.frame))
        elif kind == 5:
            slow = SLOW
        elif kind == 6 and not stalled:
            stalled = True
            time.sleep(STALL)
        if slow:
            slow -= 1
            late += SLOW_PERIOD - 1.0 / FPS
        last = replace(frame, time=frame.time + late)
        yield last
    yield DataError("the file ends within a frame")


def halved(frame: Frame) -> Frame:
    """Returns a frame of half the resolution."""
    assert frame.depth is not None
    assert frame.camera is not None
    depth, whole = np.ascontiguousarray(frame.depth[::2, ::2]), frame.camera
    camera = replace(
        whole, width=depth.shape[1], height=depth.shape[0], fx=whole.fx / 2, fy=whole.fy / 2,
        cx=whole.cx / 2, cy=whole.cy / 2,
    )  # fmt: skip
    return Frame(camera.back_projected(depth), camera, depth, frame.place)
