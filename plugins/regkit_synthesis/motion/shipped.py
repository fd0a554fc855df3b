"""The shipped motions, with defects of the clips repaired."""

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
    """A folder of shipped motions of one kind.

    Attributes:
        kind: Name of the kind, for messages.
        folder: The folder.
        prefix: Prefix of the file names.
        suffix: Suffix of the file names.
    """

    kind: str
    folder: Path
    prefix: str
    suffix: str

    @property
    def names(self) -> list[str]:
        """Returns the names of the motions."""
        files = self.folder.glob(f"{self.prefix}*{self.suffix}")
        return sorted(file.name.removeprefix(self.prefix)[: -len(self.suffix)] for file in files)

    def path(self, name: str) -> Path:
        """Returns the file of a motion.

        Raises:
            ConfigError: If there is no motion of this name.
        """
        if name not in self.names:
            raise ConfigError(
                f"no {self.kind} called '{name}' ships (there are: {', '.join(self.names)})"
                + did_you_mean(name, self.names)
            )
        return self.folder / f"{self.prefix}{name}{self.suffix}"

    def check_choice(self, name: str | None, path: Path | None) -> None:
        """Validates the choice between a shipped motion and a file.

        Raises:
            ValueError: If not exactly one is given, or no motion of this name is shipped.
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
"""Motions made for regkit."""

_MENDED: Mapping[str, Callable[[SampledMotion], SampledMotion]] = {
    # Half a cycle is joined to its mirror image after these rows, with a discontinuity.
    "walk": lambda clip: clip.bridged(18),
    "run": lambda clip: clip.bridged(11),
    # Rotating the arms outward keeps them out of the trunk of bodies that are less slim.
    "punch": lambda clip: with_arms_turned_out(clip, radians(25.0)),
    # While the leg is up, hips and chest jitter from row to row.
    "kick": lambda clip: with_arms_turned_out(clip, radians(15.0)).smoothed(),
}


def shipped_clip(name: str) -> SampledMotion:
    """Returns the shipped clip of a name, with its defects repaired.

    Raises:
        ConfigError: If there is no clip of this name.
    """
    clip = read_clip(CLIPS.path(name))
    return _MENDED[name](clip) if name in _MENDED else clip
