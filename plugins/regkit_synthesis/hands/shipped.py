"""The hand poses that ship with regkit, by name: ``iwer/point``, ``handywork/fist``."""

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
"""How the files of a folder of poses end, and what reads them."""


def pose_names() -> list[str]:
    """The names of the poses that ship."""
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
"""The name of a pose that ships."""


def shipped_pose(name: str) -> HandPose:
    """The pose of this name, which must be one of ``pose_names``."""
    folder, _, pose = name.partition("/")
    suffix, read = _READERS[folder]
    return read(ASSETS / folder / f"{pose}{suffix}")
