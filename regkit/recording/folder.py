"""The folder of one recording."""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Callable
from dataclasses import dataclass
from functools import cached_property
from pathlib import Path
from typing import ClassVar, Self

from regkit.geometry.lens import Lens
from regkit.observation import Frame, Keypoints
from regkit.recording.description import FILE, RecordingDescription
from regkit.recording.keypoints import read_keypoints
from regkit.recording.keypoints.reading import FILE as KEYPOINTS
from regkit.system.errors import DataError


@dataclass(frozen=True)
class RecordingFolder(ABC):
    """The folder of a recording: its description and the numbered files of its frames.

    Attributes:
        folder: The folder.
        description: The content of its ``sequence.yaml``.
        files: The frames' files, in temporal order.
    """

    content: ClassVar[str]
    """Name of the folder within the recording that holds the frames."""
    suffixes: ClassVar[tuple[str, ...]]
    """Suffixes of the frames' files."""
    beside: ClassVar[tuple[str, ...]] = (FILE, "truth.csv", KEYPOINTS)
    """Files beside the frames that results depend on."""

    folder: Path
    description: RecordingDescription
    files: tuple[Path, ...]

    @classmethod
    def read(
        cls,
        folder: Path,
        frames: int | None = None,
        description: RecordingDescription | None = None,
    ) -> Self:
        """Reads the description and lists the frames.

        Args:
            folder: The recording's folder.
            frames: Maximum number of frames, from the first; all by default.
            description: The description, by default that in the folder.

        Raises:
            RegkitError: If the description is invalid, there is no frame, or one is missing.
        """
        description = description or RecordingDescription.read(folder)
        files = numbered_files(folder / cls.content, cls.suffixes)[:frames]
        return cls(folder, description, tuple(files))

    @property
    def name(self) -> str:
        """Name of the recording."""
        return self.description.name or self.folder.name

    def reader(self, lens: Lens | None = None) -> Callable[[int], Frame]:
        """Returns the function that reads the frame of a number, from 0, with its landmarks.

        Args:
            lens: The camera of images; by default that in the folder.

        Raises:
            DataError: If what all frames share is damaged; the function raises it for a frame.
        """
        read, keypoints = self.measured(lens), self._keypoints
        if keypoints is None:
            return read
        return lambda number: keypoints.beside(read(number), number)

    @abstractmethod
    def measured(self, lens: Lens | None = None) -> Callable[[int], Frame]:
        """Returns the function that reads the frame of a number, from 0, without landmarks.

        Args:
            lens: As for ``reader``.

        Raises:
            DataError: If what all frames share is damaged; the function raises it for a frame.
        """

    @cached_property
    def _keypoints(self) -> Keypoints | None:
        """The keypoints beside the frames; None without any."""
        file = self.folder / KEYPOINTS
        return read_keypoints(file) if file.exists() else None

    def input_files(self) -> list[Path]:
        """Returns the frames' files, and those beside them that exist."""
        beside = (self.folder / name for name in self.beside)
        return [*self.files, *(path for path in beside if path.is_file())]


def numbered_files(folder: Path, suffixes: tuple[str, ...]) -> list[Path]:
    """Returns the files 000000, 000001, ... of a folder.

    Raises:
        DataError: If there is none, or a number is missing.
    """
    # A name that begins with a dot is an unfinished file of a recording in progress.
    files = sorted(
        path
        for path in folder.iterdir()
        if path.suffix.lower() in suffixes and not path.name.startswith(".")
    )
    if not files:
        raise DataError(f"the folder holds no {' or '.join(suffixes)} file", place=str(folder))
    for number, path in enumerate(files):
        if path.stem != f"{number:06d}":
            raise DataError(
                f"files must be numbered from 000000 without gaps; {number:06d} is missing before "
                f"{path.name}",
                place=str(folder),
            )
    return files
