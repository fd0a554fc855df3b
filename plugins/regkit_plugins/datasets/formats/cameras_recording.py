"""Recordings of several cameras in regkit's own folder format."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Self

from regkit.interfaces import Recording
from regkit.observation import Frame, Truth
from regkit.recording import CamerasFolder
from regkit.system.notes import note
from regkit_plugins.datasets.formats.folder_recording import FolderRecording
from regkit_plugins.datasets.formats.truth_file import read_truth


@dataclass(frozen=True)
class CamerasRecording(Recording):
    """A recording of several cameras; its frames are instants.

    Attributes:
        content: Its folder.
    """

    content: CamerasFolder

    @classmethod
    def of(cls, content: CamerasFolder) -> Self:
        """Returns the recording of a folder."""
        return cls(content.name, content.fps, len(content.instants), content)

    def prepare(self) -> None:
        """Checks that all cameras have a pose, and tells where one has no frame.

        Raises:
            DataError: If a camera has no pose.
        """
        self.content.check_placed()
        for absence in self.content.absences():
            note(absence, place=self.name)

    def cameras(self) -> Mapping[str, Recording]:
        """Returns the recording of each camera by its name, in its own frame."""
        return {
            camera.name: FolderRecording.of(camera.content, camera.lens)
            for camera in self.content.cameras
        }

    def frames(self) -> Iterator[Frame]:
        """Yields the instants in the world."""
        for _, frame in self.some(range(self.length)):
            yield frame

    def some(self, indices: Iterable[int]) -> Iterator[tuple[int, Frame]]:
        """Yields and reads only the instants of ``indices``."""
        self.content.check_placed()
        read = self.content.reader()
        for index in sorted(set(indices)):
            yield index, read(index)

    def input_files(self) -> list[Path]:
        """Returns the files of all cameras, and those that they share."""
        return self.content.input_files()

    def truth(self) -> Truth | None:
        """Returns the joints of ``truth.csv`` in the world by instants, or None without it."""
        return read_truth(self.content.folder / "truth.csv", self.length)
