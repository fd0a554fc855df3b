"""Datasets' folders with something wrong in them, and what is said of it."""

import shutil
from collections.abc import Callable
from pathlib import Path

import pytest

from regkit.interfaces import Dataset
from regkit.observation import Frame
from regkit.system.errors import RegkitError


def everything(dataset: Dataset) -> list[Frame]:
    """All that a run reads."""
    recordings = dataset.chosen()
    for recording in recordings:
        recording.truth()
    return [frame for recording in recordings for frame in recording.frames()]


def complaint(dataset: Dataset, root: Path) -> str:
    with pytest.raises(RegkitError) as caught:
        everything(dataset)
    return str(caught.value).replace(str(root), "ROOT")


def remove(*parts: str) -> Callable[[Path], None]:
    def act(folder: Path) -> None:
        path = folder.joinpath(*parts)
        shutil.rmtree(path) if path.is_dir() else path.unlink()

    return act


def cut(name: str, kept: float) -> Callable[[Path], None]:
    def act(folder: Path) -> None:
        content = (folder / name).read_bytes()
        (folder / name).write_bytes(content[: int(kept * len(content))])

    return act


def write(name: str, text: str | bytes) -> Callable[[Path], None]:
    def act(folder: Path) -> None:
        (folder / name).write_bytes(text.encode() if isinstance(text, str) else text)

    return act
