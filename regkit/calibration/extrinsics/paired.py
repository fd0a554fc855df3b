"""The recording of several cameras at some poses."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass
from itertools import islice
from typing import Self

from regkit.interfaces import Recording
from regkit.observation import Frame, View
from regkit.system.arrays import Array, Indices


@dataclass(frozen=True)
class PairedRecording(Recording):
    """The frames of several cameras that belong together.

    Attributes:
        each: The recording of each camera, by its name.
        poses: T_world_camera (4, 4) [m] of each camera, by its name.
        instants: The frame of each camera in each instant, (N, V); -1 for none.
    """

    each: Mapping[str, Recording]
    poses: Mapping[str, Array]
    instants: Indices

    def cameras(self) -> Mapping[str, Recording]:
        """Returns the recording of each camera by its name."""
        return self.each

    def frames(self) -> Iterator[Frame]:
        """Yields all instants."""
        for _, frame in self.some(range(self.length)):
            yield frame

    def some(self, indices: Iterable[int]) -> Iterator[tuple[int, Frame]]:
        """Yields the instants of ``indices`` with their numbers, in ascending order."""
        wanted = sorted(set(indices))
        readers = {}
        for column, (name, recording) in enumerate(self.each.items()):
            frames = [int(at) for at in self.instants[wanted, column] if at >= 0]
            readers[name] = recording.some(frames)
        for index in wanted:
            views = [
                View(name, self.poses[name], next(readers[name])[1])
                for name, at in zip(self.each, self.instants[index], strict=True)
                if at >= 0
            ]
            yield index, Frame.of_views(views, place=f"{self.name}: instant {index}")

    def truth(self) -> None:
        """Returns None: the joints are sought."""


@dataclass(frozen=True)
class FirstFrames(Recording):
    """The first frames of a recording.

    Attributes:
        whole: The recording.
    """

    whole: Recording

    @classmethod
    def of(cls, whole: Recording, count: int) -> Self:
        """Returns at most ``count`` frames of a recording."""
        return cls(whole.name, whole.fps, min(count, whole.length), whole, subject=whole.subject)

    def frames(self) -> Iterator[Frame]:
        """Yields the frames."""
        yield from islice(self.whole.frames(), self.length)

    def some(self, indices: Iterable[int]) -> Iterator[tuple[int, Frame]]:
        """Yields the frames of ``indices`` with their numbers."""
        return self.whole.some(indices)

    def truth(self) -> None:
        """Returns None: the joints are sought."""
