"""Recordings of frames in memory."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from dataclasses import dataclass

from regkit.interfaces import Recording
from regkit.observation import Frame
from regkit.system.errors import DataError


@dataclass(frozen=True)
class GivenFrames(Recording):
    """A recording of frames in memory.

    Attributes:
        given: The frames.
    """

    given: tuple[Frame, ...]

    def __post_init__(self) -> None:
        """Raises DataError if no frame holds a point."""
        if not any(len(frame.points) for frame in self.given):
            raise DataError(
                "there is no measurement: all depths or points are zero, NaN or infinite",
                place=self.name,
            )

    def cameras(self) -> dict[str, Recording]:
        """Returns the recording of each of several cameras, in its own frame."""
        seen: dict[str, list[Frame]] = {}
        for view in (view for frame in self.given for view in frame.views):
            seen.setdefault(view.name, []).append(view.data)
        return {
            name: _CameraFrames(f"{self.name}: {name}", self.fps, len(frames), tuple(frames))
            for name, frames in seen.items()
        }

    def frames(self) -> Iterator[Frame]:
        """Yields all frames."""
        yield from self.given

    def some(self, indices: Iterable[int]) -> Iterator[tuple[int, Frame]]:
        """Yields the frames of ``indices`` with their numbers, in ascending order."""
        for index in sorted(set(indices)):
            yield index, self.given[index]

    def truth(self) -> None:
        """Returns None: arrays have no reference joints."""


class _CameraFrames(GivenFrames):
    """The frames of one of several cameras, which may show nothing."""

    def __post_init__(self) -> None:
        """Accepts a camera that shows nothing: another may."""
