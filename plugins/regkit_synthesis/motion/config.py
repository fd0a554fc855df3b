"""What a user writes about a motion."""

from __future__ import annotations

from abc import ABC, abstractmethod
from typing import Annotated, Literal

from pydantic import Field, model_validator

from regkit.config.document import Document
from regkit.config.model import InputPath, Model
from regkit.system.errors import ConfigError
from regkit_synthesis.figure.map_files import MapName
from regkit_synthesis.motion.bvh import read_bvh
from regkit_synthesis.motion.clip import read_clip
from regkit_synthesis.motion.gltf import read_gltf
from regkit_synthesis.motion.keyframes import Keyframe, KeyframedMotion, Keyframes
from regkit_synthesis.motion.motion import Motion
from regkit_synthesis.motion.played import Placed, Played
from regkit_synthesis.motion.sampled import SampledMotion
from regkit_synthesis.motion.shipped import BVH, CLIPS, KEYFRAMES, shipped_clip


class MotionConfig(Model, ABC):
    """A motion and how it is played."""

    start: float = Field(default=0.0, ge=0.0)
    """Where in the motion time begins [s]."""

    speed: float = Field(default=1.0, gt=0.0)
    """How fast it is played; 1 is as recorded."""

    way: float = Field(default=1.0, ge=0.0, le=1.0)
    """The share of its mean velocity that is kept: with 0 a walk stays on the spot, as on a
    treadmill."""

    ahead: bool = True
    """Whether it is placed so that at its beginning the hips are above the origin and face forward;
    otherwise it takes place where it was recorded."""

    grounded: bool = True
    """Whether the lowest point that the body's skin reaches in the whole motion is put on the
    ground; otherwise the hips are as high as those of the source, by the length of their legs."""

    def motion(self) -> Motion:
        """The motion as it is to be played.

        Raises:
            RegkitError: If its file is missing or wrong, a name in it is unknown, or it ends before
                it starts.
        """
        source = self.source()
        if not source.loops and self.start >= source.duration:
            raise ConfigError(
                f"start is {self.start:g} s, but the motion lasts {source.duration:.3g} s"
            )
        played = Played.of(source, self.start, self.speed, self.way)
        return Placed.ahead(played) if self.ahead else played

    @abstractmethod
    def source(self) -> Motion:
        """The motion as it was recorded."""


class RecordedConfig(MotionConfig, ABC):
    """A motion of a sampled motion."""

    repeated: bool = False
    """Whether a motion that was not recorded to loop is bent to go on from its beginning."""

    def source(self) -> SampledMotion:
        """The sampled motion."""
        sampled = self.sampled()
        return sampled.looped() if self.repeated else sampled

    @abstractmethod
    def sampled(self) -> SampledMotion:
        """The sampled motion as it is in its file."""


class ClipConfig(RecordedConfig):
    """A clip of pybullet's humanoid or of DeepMimic: one that ships, or a file."""

    kind: Literal["clip"] = "clip"

    name: str | None = None
    """A clip that ships with regkit."""

    path: InputPath | None = None
    """A file of such a clip."""

    @model_validator(mode="after")
    def _one_of_them(self) -> ClipConfig:
        CLIPS.check_choice(self.name, self.path)
        return self

    def sampled(self) -> SampledMotion:
        """The clip; one that ships is mended."""
        return read_clip(self.path) if self.path else shipped_clip(self.name or "")


class BvhConfig(RecordedConfig):
    """A BVH file: one that ships, or the user's."""

    kind: Literal["bvh"] = "bvh"

    name: str | None = None
    """A motion that ships with regkit."""

    path: InputPath | None = None
    """A BVH file."""

    scale: float = Field(default=0.01, gt=0.0)
    """Its unit of length [m]. The way of a body is measured by its own legs, so that this changes
    nothing unless the body's map declares a ``root_scale``."""

    skip: int = Field(default=0, ge=0)
    """How many frames are left out at the beginning; 1 for files that begin with an added T-pose,
    as cgspeed's of CMU's recordings."""

    map: MapName | None = None
    """Which of its joints are those of a figure: the name of a map that ships (``cmu``, ``mixamo``,
    ``biovision``), or a YAML file. Without it, the first map that ships whose joints it has."""

    @model_validator(mode="after")
    def _one_of_them(self) -> BvhConfig:
        BVH.check_choice(self.name, self.path)
        return self

    def sampled(self) -> SampledMotion:
        """The motion of the file."""
        path = self.path or BVH.path(self.name or "")
        return read_bvh(path, scale=self.scale, skip=self.skip, map_name=self.map)


class GltfConfig(RecordedConfig):
    """An animation of a rigged body in a glTF file."""

    kind: Literal["gltf"] = "gltf"

    path: InputPath
    """A ``.glb`` or ``.gltf`` file."""

    animation: str | None = None
    """The animation's name in the file; without it, the file must hold one only."""

    map: MapName | None = None
    """Which of its joints are those of a figure: the name of a map that ships (``mixamo``,
    ``cesium_man``), or a YAML file. Without it, the first map that ships whose joints it has."""

    def sampled(self) -> SampledMotion:
        """The animation."""
        return read_gltf(self.path, animation=self.animation, map_name=self.map)


class KeyframesConfig(MotionConfig):
    """Poses that somebody wrote down: ones that ship, a file, or right here."""

    kind: Literal["keyframes"] = "keyframes"

    name: str | None = None
    """A motion that ships with regkit."""

    path: InputPath | None = None
    """A YAML file with ``frames``, and perhaps ``title`` and ``loops``."""

    frames: tuple[Keyframe, ...] | None = None
    """The poses, in the order of their times."""

    loops: bool = False
    """Whether ``frames`` go on from their beginning when they end."""

    @model_validator(mode="after")
    def _one_of_them(self) -> KeyframesConfig:
        if self.frames is None:
            KEYFRAMES.check_choice(self.name, self.path)
            if self.loops:
                raise ValueError("loops belongs to frames; a file says so itself")
            return self
        if self.name or self.path:
            raise ValueError("give one of name, path and frames")
        Keyframes(frames=self.frames, loops=self.loops)
        return self

    def source(self) -> KeyframedMotion:
        """The motion between the poses."""
        if self.frames is not None:
            return Keyframes(frames=self.frames, loops=self.loops).motion()
        path = self.path or KEYFRAMES.path(self.name or "")
        return Document.read(path).validated(Keyframes).motion()


AnyMotion = Annotated[
    ClipConfig | BvhConfig | GltfConfig | KeyframesConfig, Field(discriminator="kind")
]
"""A motion, by its ``kind``."""
