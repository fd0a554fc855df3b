"""Recordings that a source reads: bags of ROS, and the files of cameras."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from dataclasses import dataclass
from pathlib import Path
from typing import Literal

from regkit.interfaces import Dataset, Recording, Source, Stream
from regkit.observation import Frame
from regkit.system.errors import ConfigError


class SourceFile(Dataset):
    """The recording in a file that a source reads, as an experiment reads it."""

    kind: Literal["source"] = "source"

    source: Source
    """The source, such as ``{kind: rosbag, path: walk.mcap}``."""

    def found(self) -> list[Recording]:
        """Returns the recording.

        Raises:
            ConfigError: If the source is a camera.
            RegkitError: If it cannot be read.
        """
        with self.source.open() as stream:
            if stream.live:
                raise ConfigError(
                    f"'{stream.name}' is a camera, whose frames cannot be read again; record it "
                    "with `regkit record`, or track it with `regkit track`",
                    place="dataset.source",
                )
            # What does not know its length is read to its end.
            length = stream.length if stream.length is not None else sum(1 for _ in stream)
            if self.frames is not None:
                length = min(length, self.frames)
            return [SourceRecording(stream.name, stream.fps, length, source=self.source)]

    def input_files(self) -> Iterable[Path]:
        """Returns the files that the source reads."""
        return self.source.input_files()


@dataclass(frozen=True)
class SourceRecording(Recording):
    """The frames of a source, from its beginning each time.

    Attributes:
        source: The source.
    """

    source: Source

    def frames(self) -> Iterator[Frame]:
        """Yields the frames.

        Raises:
            RegkitError: If a frame is damaged.
        """
        with self.source.open() as stream:
            yield from self._read(stream)

    def _read(self, stream: Stream) -> Iterator[Frame]:
        for _ in range(self.length):
            timed = stream.read()
            if timed is None:
                return
            yield timed.frame

    def truth(self) -> None:
        """Returns None: no source has reference joints."""

    def input_files(self) -> Iterable[Path]:
        """Returns the files that the source reads."""
        return self.source.input_files()
