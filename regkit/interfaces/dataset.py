"""Datasets: recordings of frames, with reference joints where there are any."""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Iterable, Iterator
from dataclasses import dataclass, field
from itertools import islice
from pathlib import Path
from typing import Annotated, Any, ClassVar

from pydantic import Field

from regkit.config.model import did_you_mean
from regkit.config.plugin import Plugin
from regkit.observation import Frame, Truth
from regkit.system.errors import ConfigError, DataError


@dataclass(frozen=True)
class Recording(ABC):
    """Frames in the order of time.

    Attributes:
        name: Unique within its dataset, and fit to be a folder's name.
        fps: Frames per second at which it was recorded.
        length: Number of frames.
        subject: The dataset's name of who is seen, if it tells them apart.
    """

    name: str
    fps: float
    length: int
    subject: str | None = field(default=None, kw_only=True)

    def prepare(self) -> None:  # noqa: B027 - most recordings have nothing to prepare.
        """Make what the frames are read from, where that takes a while: render or unpack them.

        It is called before the frames are asked for, which must come all the same without it.

        Raises:
            RegkitError: If that is not possible.
        """

    @abstractmethod
    def frames(self) -> Iterator[Frame]:
        """Returns the frames, read one by one.

        Raises:
            DataError: If a frame is missing or damaged.
        """

    def some(self, indices: Iterable[int]) -> Iterator[tuple[int, Frame]]:
        """Some of the frames, in the order of time, and their numbers.

        A recording that can read any frame at once does so; others read past those between.

        Args:
            indices: The frames' numbers, from 0.

        Raises:
            DataError: If a frame is missing or damaged.
        """
        wanted = sorted(set(indices))
        # Whoever waits for the last of them must not read on.
        for index, frame in enumerate(islice(self.frames(), wanted[-1] + 1 if wanted else 0)):
            if index in wanted:
                yield index, frame

    @abstractmethod
    def truth(self) -> Truth | None:
        """Returns the reference joints of the frames, or None.

        Raises:
            DataError: If they are there but damaged.
        """


SHOWN = 5
"""A message names no more recordings than this."""


class Dataset(Plugin, ABC):
    """A set of recordings."""

    group = "regkit.datasets"
    renamed: ClassVar[dict[str, str]] = {"sequences": "recordings"}

    recordings: tuple[str, ...] | None = None
    """Names of the recordings to use; all that there are without it."""
    frames: Annotated[int, Field(ge=1)] | None = None
    """Use only so many frames from the start of each recording."""
    compared: bool = True
    """Whether poses are compared with the reference joints, where there are any."""
    joints: dict[str, str] = Field(default_factory=dict)
    """Names of the data's reference joints to the template's markers, where they differ."""

    @classmethod
    def in_folder(cls, folder: str | Path, **fields: Any) -> dict[str, Any]:
        """Data for the dataset in a folder: clouds if it has ``clouds/``, else depth images."""
        kind = "clouds" if (Path(folder) / "clouds").is_dir() else "depth"
        return cls.default(kind, root=str(folder), **fields)

    @abstractmethod
    def found(self) -> list[Recording]:
        """Every recording that there is, cut to ``frames``.

        Raises:
            DataError: If there is none, or one is damaged.
        """

    def wanted(self, name: str) -> bool:
        """Returns whether a recording is used; what is not need not even be read."""
        return self.recordings is None or name in self.recordings

    def chosen(self) -> list[Recording]:
        """Returns the recordings to use.

        Raises:
            DataError: If there is none, one is damaged, or two have the same name.
            ConfigError: If one is named that there is not.
        """
        found: dict[str, Recording] = {}
        for recording in self.found():
            if recording.name in found:
                raise DataError(f"two recordings are called '{recording.name}'", place="dataset")
            found[recording.name] = recording
        if self.recordings is None:
            return list(found.values())
        for name in self.recordings:
            if name not in found:
                raise ConfigError(
                    f"no recording '{name}' (there are: {', '.join(found)})"
                    + did_you_mean(name, list(found)),
                    place="dataset.recordings",
                )
        return [found[name] for name in self.recordings]

    def only(self, name: str | None = None) -> Recording:
        """Returns the recording of a name, or the only one that there is.

        Raises:
            DataError: If there is none, or it is damaged.
            ConfigError: If there is none of that name, or there are several.
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
