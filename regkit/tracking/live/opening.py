"""The opening of a stream: the frames in which the body, its size and surroundings are sought."""

from __future__ import annotations

from collections import deque
from collections.abc import Iterable, Iterator
from dataclasses import dataclass

from regkit.system.brief import Brief
from regkit.tracking.given_frames import GivenFrames
from regkit.tracking.live.reader import Arrived

KEPT = 15
"""Number of frames of an opening that are kept, spread over it."""

SOONEST = 1.0
"""Without a body in sight, the next opening ends this time [s] later ..."""

RARER = 0.1
"""... or this part of the time that has passed, if it is longer, since each costs a search."""


@dataclass(frozen=True)
class Opening(Brief):
    """Frames at the beginning of a stream, or later, where the body comes into sight later.

    Attributes:
        recording: Frames that were kept.
        arrived: The same frames with their numbers in the stream.
    """

    recording: GivenFrames
    arrived: tuple[Arrived, ...]

    @property
    def first(self) -> int:
        """Number of the first frame."""
        return self.arrived[0].number


def openings(frames: Iterable[Arrived], name: str, fps: float, seconds: float) -> Iterator[Opening]:
    """Yields the opening of a stream, and later ones as long as they are asked for.

    Args:
        frames: The stream's frames; damaged ones are passed over.
        name: Name of the stream.
        fps: Its nominal frame rate [1/s].
        seconds: Duration of an opening [s]; a stream that ends earlier is one opening.
    """
    spacing = seconds / KEPT
    kept: deque[tuple[float, Arrived]] = deque()
    first = due = 0.0
    for arrived in frames:
        if arrived.frame is None:
            continue
        time = arrived.frame.time
        if not kept or time < kept[-1][0]:
            # At a clock that goes back an opening ends, and another begins.
            yield from _opening(kept, name, fps)
            kept.clear()
            first, due = time, time + seconds
        if not kept or time >= kept[-1][0] + spacing:
            kept.append((time, arrived))
        while time > kept[0][0] + seconds + spacing:
            kept.popleft()
        if time >= due:
            yield from _opening(kept, name, fps)
            due = time + max(SOONEST, RARER * (time - first))
    yield from _opening(kept, name, fps)


def _opening(kept: Iterable[tuple[float, Arrived]], name: str, fps: float) -> Iterator[Opening]:
    """Yields the opening of some frames, if one has a measurement."""
    arrived = tuple(one for _, one in kept)
    frames = tuple(one.frame.frame for one in arrived if one.frame is not None)
    if any(len(frame.points) for frame in frames):
        recording = GivenFrames(name=name, fps=fps, length=len(frames), given=frames)
        yield Opening(recording, arrived)
