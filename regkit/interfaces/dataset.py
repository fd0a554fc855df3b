"""Datasets: recordings of frames, with reference joints where there are any."""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Iterator
from dataclasses import dataclass, field
from typing import Annotated, ClassVar

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
        """The frames, read one by one.

        Raises:
            DataError: If a frame is missing or damaged.
        """

    @abstractmethod
    def truth(self) -> Truth | None:
        """The reference joints of the frames, or None.

        Raises:
            DataError: If they are there but damaged.
        """


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

    @abstractmethod
    def found(self) -> list[Recording]:
        """Every recording that there is, cut to ``frames``.

        Raises:
            DataError: If there is none, or one is damaged.
        """

    def wanted(self, name: str) -> bool:
        """Whether a recording is used; what is not need not even be read."""
        return self.recordings is None or name in self.recordings

    def chosen(self) -> list[Recording]:
        """The recordings to use.

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
