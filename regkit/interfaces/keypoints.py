"""Recordings and streams with the keypoints of another file beside their frames."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass
from pathlib import Path

from regkit.interfaces.dataset import Recording
from regkit.interfaces.stream import Stream
from regkit.observation import Frame, Keypoints, TimedFrame, Truth
from regkit.recording.keypoints import read_keypoints
from regkit.system.errors import ConfigError


@dataclass(frozen=True)
class KeypointRecording(Recording):
    """A recording whose frames have landmarks.

    Attributes:
        whole: The recording.
        keypoints: The keypoints of its frames.
    """

    whole: Recording
    keypoints: Keypoints

    @classmethod
    def of(cls, whole: Recording, keypoints: Keypoints) -> KeypointRecording:
        """Returns a recording with keypoints."""
        return cls(whole.name, whole.fps, whole.length, whole, keypoints, subject=whole.subject)

    def prepare(self) -> None:
        """Prepares the source of the frames."""
        self.whole.prepare()

    def frames(self) -> Iterator[Frame]:
        """Yields all frames with their landmarks."""
        for number, frame in enumerate(self.whole.frames()):
            yield self.keypoints.beside(frame, number)

    def some(self, indices: Iterable[int]) -> Iterator[tuple[int, Frame]]:
        """Yields selected frames with their landmarks and indices."""
        for number, frame in self.whole.some(indices):
            yield number, self.keypoints.beside(frame, number)

    def truth(self) -> Truth | None:
        """Returns the reference joints of the recording."""
        return self.whole.truth()

    def input_files(self) -> Iterable[Path] | None:
        """Returns the recording's files and those of the keypoints."""
        files = self.whole.input_files()
        return None if files is None else [*files, *self.keypoints.files]

    def fingerprint(self) -> str:
        """Returns the recording's own fingerprint."""
        return self.whole.fingerprint()


class KeypointStream(Stream):
    """A stream whose frames have landmarks, by their numbers.

    Args:
        whole: The stream, which is closed with this one.
        keypoints: The keypoints of its frames.

    Raises:
        ConfigError: If the stream is live: nobody knows the numbers of its frames beforehand.
    """

    def __init__(self, whole: Stream, keypoints: Keypoints) -> None:
        if whole.live:
            raise ConfigError(
                f"'{whole.name}' is a camera, whose frames have no keypoints in a file; record it"
            )
        self.name, self.fps, self.length = whole.name, whole.fps, whole.length
        self.depth_scale = whole.depth_scale
        self._whole, self._keypoints, self._next = whole, keypoints, 0

    def read(self) -> TimedFrame | None:
        """Returns the next frame with its landmarks; None at the end.

        Raises:
            DataError: If the frame is damaged.
            SourceLostError: If the stream yields no further frame.
        """
        number, self._next = self._next, self._next + 1
        timed = self._whole.read()
        self.dropped = self._whole.dropped
        if timed is None:
            return None
        return TimedFrame(self._keypoints.beside(timed.frame, number), timed.time)

    def close(self) -> None:
        """Closes the stream."""
        self._whole.close()


def with_keypoints(
    recordings: Iterable[Recording], path: Path, markers: Mapping[str, str]
) -> list[Recording]:
    """Returns recordings with the keypoints of a file, or of a file for each of them.

    Args:
        recordings: The recordings.
        path: Keypoints of the only recording; or a folder with a file or folder for each, of its
            name.
        markers: Marker of the template for each keypoint whose name differs.

    Raises:
        ConfigError: If ``path`` belongs to one recording, and there are several.
        DataError: If keypoints are missing or damaged.
    """
    several = list(recordings)
    own = {one.name: _file_of(path, one.name) for one in several}
    if len(several) == 1 and own[several[0].name] is None:
        own[several[0].name] = path
    if several and all(file is None for file in own.values()):
        raise ConfigError(
            f"there are {len(several)} recordings; name one (recordings), or give a folder with "
            f"the keypoints of each, such as {path / several[0].name}.csv",
            place="dataset.keypoints",
        )
    found: list[Recording] = []
    for one in several:
        file = own[one.name]
        # A recording without a file has no keypoints.
        found.append(
            one if file is None else KeypointRecording.of(one, read_keypoints(file, markers))
        )
    return found


def _file_of(folder: Path, name: str) -> Path | None:
    """Returns the keypoints of a recording in a folder of several; None without any."""
    for suffix in (".csv", ".json", ""):
        if (folder / f"{name}{suffix}").exists():
            return folder / f"{name}{suffix}"
    return None
