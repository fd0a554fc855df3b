"""Datasets: recordings of frames, with reference joints if available."""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass, field, replace
from itertools import islice
from pathlib import Path
from typing import Any, ClassVar

from pydantic import Field

from regkit.config.input_files import paths_in
from regkit.config.model import InputPath, did_you_mean
from regkit.config.plugin import Plugin
from regkit.config.quantities import FrameCount
from regkit.interfaces.source import Source
from regkit.observation import Frame, Truth
from regkit.system.brief import Brief
from regkit.system.errors import ConfigError, DataError
from regkit.system.names import file_name
from regkit.system.notes import note
from regkit.system.printable import one_line


@dataclass(frozen=True)
class Recording(Brief, ABC):
    """Frames in temporal order.

    Attributes:
        name: Name, unique within the dataset and valid as a folder name.
        fps: Frame rate of the recording [1/s].
        length: Number of frames.
        subject: Identifier of the recorded subject, if the dataset distinguishes them.
    """

    name: str
    fps: float
    length: int
    subject: str | None = field(default=None, kw_only=True)

    def prepare(self) -> None:
        """Prepares the source of the frames where that takes a while, such as rendering.

        It is called before the frames are requested, but the frames must also be available
        without it.

        Raises:
            RegkitError: If the preparation fails.
        """

    def cameras(self) -> Mapping[str, Recording]:
        """Returns the recording of each of several cameras by its name, in its own frame.

        Their frames need not be at the same times. The default is none: there is one camera.
        """
        return {}

    @abstractmethod
    def frames(self) -> Iterator[Frame]:
        """Returns the frames, read one by one.

        Raises:
            DataError: If a frame is missing or damaged.
        """

    def some(self, indices: Iterable[int]) -> Iterator[tuple[int, Frame]]:
        """Yields selected frames with their indices, in temporal order.

        The default reads all frames in between; recordings with random access override it.

        Args:
            indices: Indices of the frames, from 0.

        Raises:
            DataError: If a frame is missing or damaged.
        """
        wanted = sorted(set(indices))
        # Stop after the last frame: reading on would delay the caller.
        for index, frame in enumerate(islice(self.frames(), wanted[-1] + 1 if wanted else 0)):
            if index in wanted:
                yield index, frame

    @abstractmethod
    def truth(self) -> Truth | None:
        """Returns the reference joints of the frames; None without any.

        Raises:
            DataError: If the reference is damaged.
        """

    def input_files(self) -> Iterable[Path] | None:
        """Returns the files that the frames and the reference joints are read from.

        Results on the recording are bound to their content: after a change they are done again.
        The default, None, stands for all files that the dataset's configuration names, with the
        content of folders.
        """
        return None

    def fingerprint(self) -> str:
        """Returns a text that changes with the content of the recording beyond its files.

        A recording that is computed returns the digest of what it is computed from; the
        configuration and the version of the plug-in need not be part of it. The default is empty.

        Raises:
            RegkitError: If what it is computed from is missing or damaged.
        """
        return ""


MARKERS = (".trc", ".c3d")
"""Suffixes of files of markers."""

SHOWN = 5
"""Maximum number of recordings in a message."""


class Dataset(Plugin, ABC):
    """A set of recordings."""

    group = "regkit.datasets"
    renamed: ClassVar[dict[str, str]] = {"sequences": "recordings"}

    recordings: tuple[str, ...] | None = None
    """Names of the recordings to use; all by default."""
    frames: FrameCount | None = None
    """Maximum number of frames from the start of each recording; all by default."""
    compared: bool = True
    """Whether to compare poses with the reference joints, if there are any."""
    joints: dict[str, str] = Field(default_factory=dict)
    """Map from the reference joints to the template's markers, where the names differ."""
    keypoints: InputPath | None = None
    """Keypoints of the recording: a ``.csv`` file, a ``.json`` file of MediaPipe, or the folder of
    OpenPose's files; or a folder that holds one of these for each recording, of its name."""
    keypoint_markers: dict[str, str] = Field(default_factory=dict)
    """Map from the keypoints to the template's markers, beside those of the known detectors."""

    @classmethod
    def at(cls, path: str | Path, **fields: Any) -> dict[str, Any]:
        """Returns data for the dataset of a path.

        Args:
            path: A folder, of clouds if it has ``clouds/``, of several cameras if it has
                ``cameras.json``, else of depth images; a file of markers; or a file or folder that
                a source reads.
            fields: Fields of the dataset.

        Raises:
            RegkitError: If no source reads the file.
        """
        folder = Path(path)
        if (folder / "clouds").is_dir():
            return cls.default("clouds", root=str(path), **fields)
        if folder.suffix.lower() in MARKERS:
            return cls.default("markers", path=str(path), **fields)
        if folder.is_file() or (folder / "metadata.yaml").is_file():
            return cls.default("source", source=Source.described(path), **fields)
        return cls.default("depth", root=str(path), **fields)

    @abstractmethod
    def found(self) -> list[Recording]:
        """Returns all recordings, truncated to ``frames``.

        Raises:
            DataError: If there is none, or one is damaged.
        """

    def input_files(self) -> Iterable[Path]:
        """Returns all paths in the configuration: a dataset only reads."""
        return paths_in(self, Plugin)

    def wanted(self, name: str) -> bool:
        """Returns whether a recording is used; others need not be read."""
        return self.recordings is None or name in self.recordings

    def chosen(self) -> list[Recording]:
        """Returns the recordings to use.

        Raises:
            DataError: If there is none, one is damaged, or two have the same name.
            ConfigError: If ``recordings`` contains an unknown name.
        """
        found: dict[str, Recording] = {}
        for recording in map(_named_for_files, self.found()):
            if recording.name in found:
                raise DataError(
                    f"two recordings are called '{recording.name}'; give each its name, or, if "
                    "they are of several cameras at one time, describe these in cameras.json",
                    place="dataset",
                )
            found[recording.name] = recording
        if self.recordings is None:
            return self._beside_keypoints(found.values())
        chosen = [name if name in found else file_name(name) for name in self.recordings]
        for name in chosen:
            if name not in found:
                raise ConfigError(
                    f"no recording '{name}' (there are: {', '.join(found)})"
                    + did_you_mean(name, list(found)),
                    place="dataset.recordings",
                )
        return self._beside_keypoints(found[name] for name in chosen)

    def _beside_keypoints(self, recordings: Iterable[Recording]) -> list[Recording]:
        """Returns recordings with their keypoints, if the dataset names some."""
        if self.keypoints is None:
            return list(recordings)
        # A recording with keypoints is a recording, so its module needs this one.
        from regkit.interfaces.keypoints import with_keypoints

        return with_keypoints(recordings, self.keypoints, self.keypoint_markers)

    def only(self, name: str | None = None) -> Recording:
        """Returns the recording of a name, or the only recording.

        Raises:
            DataError: If there is none, or it is damaged.
            ConfigError: If the name is unknown, or missing although there are several.
        """
        if name is not None:
            return self.model_copy(update={"recordings": (name,)}).chosen()[0]
        found = self.chosen()
        if len(found) > 1:
            names = ", ".join(recording.name for recording in found[:SHOWN])
            more = ", ..." if len(found) > SHOWN else ""
            raise ConfigError(
                f"there are {len(found)} recordings ({names}{more}); name one",
                place="dataset.recordings",
            )
        return found[0]


def _named_for_files(recording: Recording) -> Recording:
    """Returns a recording whose name, often that of a foreign folder, is valid for files."""
    name = file_name(recording.name)
    if name == recording.name:
        return recording
    note(f"the recording '{one_line(recording.name)}' is called '{name}' in results")
    return replace(recording, name=name)
