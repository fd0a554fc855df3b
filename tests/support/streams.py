"""Streams made of a script: frames, faults and pauses."""

import time
from collections.abc import Callable, Iterable
from pathlib import Path

import numpy as np
from places import DATA

from regkit.interfaces import Source, Stream, TimedFrame
from regkit.observation import Frame
from regkit.system.errors import RegkitError

WALK = DATA / "human_walk"
FPS = 30.0


class Scripted(Stream):
    """Yields frames, raises errors, calls functions and waits for the seconds of numbers."""

    fps = FPS

    def __init__(
        self,
        script: Iterable[TimedFrame | RegkitError | Callable[[], object] | float],
        *,
        live: bool = False,
    ) -> None:
        self.name = "scripted"
        self.live = live
        self.is_closed = False
        self._script = iter(script)

    def read(self) -> TimedFrame | None:
        for one in self._script:
            if isinstance(one, RegkitError):
                raise one
            if isinstance(one, TimedFrame):
                return one
            if callable(one):
                one()
            else:
                time.sleep(one)
        return None

    def close(self) -> None:
        self.is_closed = True


def walk_frames(count: int, folder: Path = WALK) -> list[TimedFrame]:
    """The first frames of the shipped walk."""
    with Source.at(folder).open() as stream:
        return [frame for _ in range(count) if (frame := stream.read()) is not None]


def empty_frame(time: float) -> TimedFrame:
    """A frame of the walk's camera without a measurement."""
    (seen,) = walk_frames(1)
    blank = np.zeros_like(seen.frame.depth)
    return TimedFrame(Frame(np.zeros((0, 3)), seen.frame.camera, blank, "empty"), time)
