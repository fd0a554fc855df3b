"""The clips that ship with regkit, without their defects."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from math import radians
from pathlib import Path

from regkit.errors import ConfigError
from regkit.model import did_you_mean
from regkit_plugins.synthesis.motion.clip import read_clip, with_arms_turned_out
from regkit_plugins.synthesis.motion.recording import Recording

_FOLDER = Path(__file__).resolve().parents[2] / "assets" / "humanoid_pybullet"

_PREFIX = "humanoid3d_"

_MENDED: Mapping[str, Callable[[Recording], Recording]] = {
    # Half a cycle meets its mirror image after these rows, and does not quite go on.
    "walk": lambda clip: clip.bridged(18),
    "run": lambda clip: clip.bridged(11),
    # The arms are turned out to keep them out of the trunk of a body that is not as slim.
    "punch": lambda clip: with_arms_turned_out(clip, radians(25.0)),
    # While the leg is up, hips and chest shake against each other from row to row.
    "kick": lambda clip: with_arms_turned_out(clip, radians(15.0)).smoothed(),
}


def clip_names() -> list[str]:
    """The names of the clips."""
    return sorted(path.stem.removeprefix(_PREFIX) for path in _FOLDER.glob(f"{_PREFIX}*.txt"))


def shipped_clip(name: str) -> Recording:
    """The clip of this name.

    Raises:
        ConfigError: If there is none.
    """
    if name not in clip_names():
        raise ConfigError(
            f"no clip '{name}' ships (there are: {', '.join(clip_names())})"
            + did_you_mean(name, clip_names())
        )
    clip = read_clip(_FOLDER / f"{_PREFIX}{name}.txt")
    return _MENDED[name](clip) if name in _MENDED else clip
