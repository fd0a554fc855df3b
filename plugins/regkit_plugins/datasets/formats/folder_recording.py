"""Recordings in regkit's own folder format."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from dataclasses import dataclass
from pathlib import Path
from typing import Self

from regkit.geometry.lens import Lens
from regkit.interfaces import Recording
from regkit.observation import Frame, Truth
from regkit.recording import RecordingFolder
from regkit_plugins.datasets.formats.truth_file import read_truth


@dataclass(frozen=True)
class FolderRecording(Recording):
    """A recording of depth images or clouds.

    Attributes:
        content: Its folder.
        lens: The camera of its images, if it is not that in the folder.
    """

    content: RecordingFolder
    lens: Lens | None = None

    @classmethod
    def of(cls, content: RecordingFolder, lens: Lens | None = None) -> Self:
        """Returns the recording of a folder.

        Args:
            content: The folder.
            lens: The camera of its images; by default that in the folder.
        """
        return cls(content.name, content.description.fps, len(content.files), content, lens)

    def frames(self) -> Iterator[Frame]:
        """Yields the frames in the camera's frame (x right, y down, z forward)."""
        for _, frame in self.some(range(self.length)):
            yield frame

    def some(self, indices: Iterable[int]) -> Iterator[tuple[int, Frame]]:
        """Yields and reads only the frames of ``indices``."""
        read = self.content.reader(self.lens)
        for index in sorted(set(indices)):
            yield index, read(index)

    def input_files(self) -> list[Path]:
        """Returns the frames' files, and those beside them that exist."""
        return self.content.input_files()

    def truth(self) -> Truth | None:
        """Returns the joints of ``truth.csv``, or None without it."""
        return read_truth(self.content.folder / "truth.csv", self.length)
