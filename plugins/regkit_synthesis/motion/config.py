"""The YAML form of motions."""

from __future__ import annotations

from abc import ABC, abstractmethod
from typing import Annotated, Literal

from pydantic import Field, model_validator

from regkit.config.document import Document
from regkit.config.model import InputPath, Model
from regkit.config.quantities import Duration, Factor, Share
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
    """A motion and its playback."""

    start: Duration = 0.0
    """Start time within the motion [s]."""

    speed: Annotated[float, Field(ge=1e-3, le=1e3)] = 1.0
    """Playback speed; 1 is the recorded speed."""

    way: Share = 1.0
    """Fraction of the mean velocity that is kept; with 0 a walk stays in place, as on a
    treadmill."""

    ahead: bool = True
    """Whether to place the motion so that the hips start above the origin and face forward;
    otherwise it has the recorded position."""

    grounded: bool = True
    """Whether to put the lowest point of the body's skin over the whole motion on the ground;
    otherwise the height of the hips is that of the source, scaled by the length of the legs."""

    def motion(self) -> Motion:
        """Returns the motion with its playback.

        Raises:
            RegkitError: If its file is missing or invalid, a name in it is unknown, or it ends
                before ``start``.
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
        """Returns the motion as recorded."""


class RecordedConfig(MotionConfig, ABC):
    """A recorded motion."""

    repeated: bool = False
    """Whether to adjust a motion that does not loop so that it continues from its beginning."""

    def source(self) -> SampledMotion:
        """Returns the recorded motion, looped if required."""
        sampled = self.sampled()
        return sampled.looped() if self.repeated else sampled

    @abstractmethod
    def sampled(self) -> SampledMotion:
        """Returns the recorded motion as in its file."""


class ClipConfig(RecordedConfig):
    """A clip of pybullet's humanoid or DeepMimic, shipped or in a file."""

    kind: Literal["clip"] = "clip"

    name: str | None = None
    """Name of a shipped clip."""

    path: InputPath | None = None
    """File of a clip."""

    @model_validator(mode="after")
    def _one_of_them(self) -> ClipConfig:
        CLIPS.check_choice(self.name, self.path)
        return self

    def sampled(self) -> SampledMotion:
        """Returns the clip; defects of shipped clips are repaired."""
        return read_clip(self.path) if self.path else shipped_clip(self.name or "")


class BvhConfig(RecordedConfig):
    """A BVH motion, shipped or in a file."""

    kind: Literal["bvh"] = "bvh"

    name: str | None = None
    """A motion that ships with regkit."""

    path: InputPath | None = None
    """A BVH file."""

    scale: Factor = 0.01
    """Unit of length of the file [m]. Motion is scaled by the length of the legs, so this has an
    effect only if the body's map declares a ``root_scale``."""

    skip: Annotated[int, Field(ge=0, le=10_000_000)] = 0
    """Number of frames to skip at the beginning; 1 for files that begin with an added T-pose, such
    as cgspeed's conversion of the CMU recordings."""

    map: MapName | None = None
    """Map from its joints to the figure: the name of a shipped map (``cmu``, ``mixamo``,
    ``biovision``), or a YAML file; by default the first shipped map that fits."""

    @model_validator(mode="after")
    def _one_of_them(self) -> BvhConfig:
        BVH.check_choice(self.name, self.path)
        return self

    def sampled(self) -> SampledMotion:
        """Returns the motion in the file."""
        path = self.path or BVH.path(self.name or "")
        return read_bvh(path, scale=self.scale, skip=self.skip, map_name=self.map)


class GltfConfig(RecordedConfig):
    """An animation of a rigged body in a glTF file."""

    kind: Literal["gltf"] = "gltf"

    path: InputPath
    """A ``.glb`` or ``.gltf`` file."""

    animation: str | None = None
    """Name of the animation; required if the file has several."""

    map: MapName | None = None
    """Map from its joints to the figure: the name of a shipped map (``mixamo``, ``cesium_man``), or
    a YAML file; by default the first shipped map that fits."""

    def sampled(self) -> SampledMotion:
        """Returns the animation."""
        return read_gltf(self.path, animation=self.animation, map_name=self.map)


class KeyframesConfig(MotionConfig):
    """A motion through keyframes, shipped, in a file, or inline."""

    kind: Literal["keyframes"] = "keyframes"

    name: str | None = None
    """A motion that ships with regkit."""

    path: InputPath | None = None
    """A YAML file with ``frames``, and optionally ``title`` and ``loops``."""

    frames: tuple[Keyframe, ...] | None = None
    """The poses, in the order of their times."""

    loops: bool = False
    """Whether ``frames`` repeat."""

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
        """Returns the motion through the keyframes."""
        if self.frames is not None:
            return Keyframes(frames=self.frames, loops=self.loops).motion()
        path = self.path or KEYFRAMES.path(self.name or "")
        return Document.read(path).validated(Keyframes).motion()


AnyMotion = Annotated[
    ClipConfig | BvhConfig | GltfConfig | KeyframesConfig, Field(discriminator="kind")
]
"""A motion, by its ``kind``."""
