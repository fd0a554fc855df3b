"""Recordings in regkit's own folder format."""

from __future__ import annotations

from pathlib import Path
from typing import Literal

from regkit.config.model import InputPath
from regkit.interfaces import Source, Stream, TimedFrame
from regkit.recording import CloudFolder, DepthFolder, RecordingFolder
from regkit.recording.times import FILE, read_times
from regkit.system.errors import DataError

CONTENTS: tuple[type[RecordingFolder], ...] = (CloudFolder, DepthFolder)
"""What a folder may hold, as a dataset looks for it."""


class Folder(Source):
    """A folder of depth images or clouds, ``depth/`` or ``clouds/`` beside a ``sequence.yaml``.

    Times are those of ``times.csv``, or else the frames' numbers divided by the frame rate.
    """

    kind: Literal["folder"] = "folder"

    path: InputPath
    """Folder of the recording."""

    @classmethod
    def accepts(cls, path: Path) -> bool:
        """Returns whether a folder contains ``depth/`` or ``clouds/``."""
        return any((path / one.content).is_dir() for one in CONTENTS)

    def open(self) -> Stream:
        """Opens the recording at its first frame.

        Raises:
            RegkitError: If it is no recording, or its description, camera or times are damaged.
        """
        for content in CONTENTS:
            if (self.path / content.content).is_dir():
                return FolderStream(content.read(self.path))
        raise DataError("this is no folder with depth/ or clouds/ in it", place=str(self.path))


class FolderStream(Stream):
    """The frames of a recording's folder."""

    def __init__(self, content: RecordingFolder) -> None:
        """Reads what all frames share.

        Raises:
            DataError: If the camera or the times are damaged.
        """
        self.name = content.name
        self.fps = content.description.fps
        self.length = len(content.files)
        self.depth_scale = content.description.depth_scale
        self._times = read_times(content.folder / FILE, self.length)
        self._frame = content.reader()
        self._next = 0

    def read(self) -> TimedFrame | None:
        """Returns the next frame; None at the end.

        Raises:
            DataError: If the frame is damaged.
        """
        index = self._next
        if self.length is None or index >= self.length:
            return None
        self._next += 1
        time = index / self.fps if self._times is None else float(self._times[index])
        return TimedFrame(self._frame(index), time)
