"""The motions that ship with regkit; clips without their defects."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from math import radians
from pathlib import Path

from regkit.config.model import did_you_mean
from regkit.system.errors import ConfigError
from regkit_synthesis.assets import ASSETS
from regkit_synthesis.motion.clip import read_clip, with_arms_turned_out
from regkit_synthesis.motion.sampled import SampledMotion


@dataclass(frozen=True)
class Shelf:
    """A folder of motions of one kind.

    Attributes:
        kind: What they are called.
        folder: Where they lie.
        prefix: What their files' names begin with.
        suffix: What their files' names end with.
    """

    kind: str
    folder: Path
    prefix: str
    suffix: str

    @property
    def names(self) -> list[str]:
        """The names of the motions."""
        files = self.folder.glob(f"{self.prefix}*{self.suffix}")
        return sorted(file.name.removeprefix(self.prefix)[: -len(self.suffix)] for file in files)

    def path(self, name: str) -> Path:
        """The file of the motion of this name.

        Raises:
            ConfigError: If there is none.
        """
        if name not in self.names:
            raise ConfigError(
                f"no {self.kind} called '{name}' ships (there are: {', '.join(self.names)})"
                + did_you_mean(name, self.names)
            )
        return self.folder / f"{self.prefix}{name}{self.suffix}"

    def check_choice(self, name: str | None, path: Path | None) -> None:
        """Refuse a choice that is none, or one of a motion that does not ship.

        Raises:
            ValueError: If not just one is given, or nothing of this name ships.
        """
        if (name is None) == (path is None):
            raise ValueError(f"give either a path or a name ({', '.join(self.names)})")
        if name is not None:
            try:
                self.path(name)
            except ConfigError as error:
                raise ValueError(str(error)) from None


CLIPS = Shelf("clip", ASSETS / "humanoid_pybullet", "humanoid3d_", ".txt")
"""Clips of DeepMimic, as shipped with pybullet."""

BVH = Shelf("BVH motion", ASSETS / "bvhtoolbox", "", ".bvh")
"""Motions of bvhtoolbox."""

KEYFRAMES = Shelf("keyframed motion", ASSETS / "keyframes", "", ".yaml")
"""Motions that were written for regkit."""

_MENDED: Mapping[str, Callable[[SampledMotion], SampledMotion]] = {
    # Half a cycle meets its mirror image after these rows, and does not quite go on.
    "walk": lambda clip: clip.bridged(18),
    "run": lambda clip: clip.bridged(11),
    # The arms are turned out to keep them out of the trunk of a body that is not as slim.
    "punch": lambda clip: with_arms_turned_out(clip, radians(25.0)),
    # While the leg is up, hips and chest shake against each other from row to row.
    "kick": lambda clip: with_arms_turned_out(clip, radians(15.0)).smoothed(),
}


def shipped_clip(name: str) -> SampledMotion:
    """The clip of this name, without its defects.

    Raises:
        ConfigError: If there is none.
    """
    clip = read_clip(CLIPS.path(name))
    return _MENDED[name](clip) if name in _MENDED else clip
