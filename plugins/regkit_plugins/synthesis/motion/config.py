"""What a user writes about a motion."""

from __future__ import annotations

from abc import ABC, abstractmethod
from typing import Annotated, Literal

from pydantic import Field, model_validator

from regkit.model import InputPath, Model
from regkit_plugins.synthesis.motion.clip import read_clip
from regkit_plugins.synthesis.motion.clips import clip_names, shipped_clip
from regkit_plugins.synthesis.motion.motion import Motion, Played
from regkit_plugins.synthesis.motion.recording import Recording


class MotionConfig(Model, ABC):
    """A motion and how it is played."""

    start: float = Field(default=0.0, ge=0.0)
    """Where in the motion time begins [s]."""

    speed: float = Field(default=1.0, gt=0.0)
    """How fast it is played; 1 is as recorded."""

    way: float = Field(default=1.0, ge=0.0, le=1.0)
    """The share of its mean velocity that is kept: with 0 a walk stays on the spot, as on a
    treadmill."""

    def motion(self) -> Motion:
        """The motion as it is to be played.

        Raises:
            RegkitError: If its file is missing or wrong, or a name in it is unknown.
        """
        return Played.of(self.source(), self.start, self.speed, self.way)

    @abstractmethod
    def source(self) -> Motion:
        """The motion as it was recorded."""


class ClipConfig(MotionConfig):
    """A clip of pybullet's humanoid or of DeepMimic: one that ships, or a file."""

    kind: Literal["clip"] = "clip"

    name: str | None = None
    """A clip that ships with regkit."""

    path: InputPath | None = None
    """A file of such a clip."""

    repeated: bool = False
    """Whether a clip that was not recorded to loop is bent to go on from its beginning."""

    @model_validator(mode="after")
    def _one_of_them(self) -> ClipConfig:
        if (self.name is None) == (self.path is None):
            raise ValueError(f"give either a path or one of the names {', '.join(clip_names())}")
        return self

    def source(self) -> Recording:
        """The clip."""
        clip = read_clip(self.path) if self.path else shipped_clip(self.name or "")
        return clip.looped() if self.repeated else clip


AnyMotion = Annotated[ClipConfig, Field(discriminator="kind")]
"""A motion, by its ``kind``."""
