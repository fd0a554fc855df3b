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

    def frames(self) -> Iterator[Frame]:
        """Yields all frames."""
        yield from self.given

    def some(self, indices: Iterable[int]) -> Iterator[tuple[int, Frame]]:
        """Yields the frames of ``indices`` with their numbers, in ascending order."""
        for index in sorted(set(indices)):
            yield index, self.given[index]

    def truth(self) -> None:
        """Returns None: arrays have no reference joints."""
