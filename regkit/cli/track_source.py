"""The source of ``regkit track``: a camera, a recording's file or folder, or one of several."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from typing import Any

from regkit.cli.options import options
from regkit.interfaces import Dataset, KeypointStream, Recording, Source, Stream
from regkit.interfaces.dataset import MARKERS
from regkit.recording.keypoints import read_keypoints
from regkit.system.errors import ConfigError, DataError
from regkit.tracking.live import LimitedStream, RecordingStream

Opener = Callable[[], Stream]


def described(address: str, recording: str | None) -> dict[str, Any] | None:
    """Returns the data of the source of an address; None for what a dataset reads.

    Args:
        address: The argument of the command.
        recording: Name of one of several recordings in a folder.

    Raises:
        RegkitError: If there is no such file, or no source reads it.
    """
    if Path(address).suffix.lower() in MARKERS:
        return None
    if not Path(address).is_dir():
        return Source.described(address)
    if recording is not None:
        return None
    try:
        return Source.described(address)
    except DataError:
        return None


def opener(
    address: str,
    source: Source | None,
    recording: str | None,
    frames: int | None,
    keypoints: Path | None = None,
) -> Opener:
    """Returns what opens the stream.

    Args:
        address: The argument of the command.
        source: The source; None for a folder that a dataset reads.
        recording: Name of one of several recordings in the folder.
        frames: Largest number of frames; all for None.
        keypoints: File of the frames' keypoints.

    Raises:
        RegkitError: If the folder holds no recording, or several and none is named; or the
            keypoints are damaged.
    """
    if source is not None:
        opened = source.open
    else:
        found = dataset_recording(address, recording, None)
        found.prepare()

        def opened() -> Stream:
            return RecordingStream(found)

    beside = opened if keypoints is None else _with_keypoints(opened, keypoints)
    if frames is None:
        return beside
    return lambda: LimitedStream(beside(), frames)


def _with_keypoints(opened: Opener, file: Path) -> Opener:
    """Returns what opens a stream with keypoints."""
    found = read_keypoints(file)

    def beside() -> Stream:
        try:
            return KeypointStream(opened(), found)
        except ConfigError as error:
            raise error.at("--keypoints") from None

    return beside


def dataset_recording(
    address: str, name: str | None, frames: int | None, keypoints: Path | None = None
) -> Recording:
    """Returns a recording in a folder.

    Args:
        address: The folder.
        name: Name of the recording, if there are several.
        frames: Largest number of frames; all for None.
        keypoints: File of the frames' keypoints.

    Raises:
        RegkitError: If the folder holds no recording, or several and none is named.
    """
    given = {} if keypoints is None else {"keypoints": str(keypoints)}
    data = Dataset.at(address, frames=frames, **given)
    with options(**{"dataset.recordings": "--recording"}):
        return Dataset.parse(data, place="SOURCE", field="dataset").only(name)
