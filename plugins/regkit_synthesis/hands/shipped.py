"""The shipped hand poses, by names such as ``iwer/point`` or ``handywork/fist``."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from pathlib import Path
from typing import Annotated

from pydantic import AfterValidator

from regkit.config.model import did_you_mean
from regkit_synthesis.assets import ASSETS
from regkit_synthesis.hands.handywork import read_handywork
from regkit_synthesis.hands.iwer import read_iwer
from regkit_synthesis.hands.pose import HandPose

_READERS: Mapping[str, tuple[str, Callable[[Path], HandPose]]] = {
    "handywork": (".handpose", read_handywork),
    "iwer": (".js", read_iwer),
}
"""Suffix and reader of the files in each folder of poses."""


def pose_names() -> list[str]:
    """Returns the names of the shipped poses."""
    return sorted(
        f"{folder}/{path.stem}"
        for folder, (suffix, _) in _READERS.items()
        for path in (ASSETS / folder).glob(f"*{suffix}")
    )


def _known(name: str) -> str:
    names = pose_names()
    if name not in names:
        raise ValueError(
            f"no hand pose called '{name}' ships (there are: {', '.join(names)})"
            + did_you_mean(name, names)
        )
    return name


PoseName = Annotated[str, AfterValidator(_known)]
"""The name of a shipped pose."""


def shipped_pose(name: str) -> HandPose:
    """Returns the shipped pose of a name, one of ``pose_names``."""
    folder, _, pose = name.partition("/")
    suffix, read = _READERS[folder]
    return read(ASSETS / folder / f"{pose}{suffix}")
