"""Template files, each read once."""

from __future__ import annotations

from functools import lru_cache
from pathlib import Path

from regkit.body import BodyDescription, ParametricShape
from regkit.config.document import Document
from regkit.config.registry import registered

FOLDER = Path(__file__).resolve().parent
"""Where the templates lie that ship with regkit."""


def description_in(path: Path) -> BodyDescription:
    """The template in a YAML file.

    It is read again only if it has changed, or other shape models are registered to check it.

    Raises:
        RegkitError: If the file is missing or wrong.
    """
    changed = path.stat().st_mtime_ns if path.is_file() else 0
    return _read(path, changed, tuple(registered(ParametricShape.group).items()))


@lru_cache(maxsize=32)
def _read(path: Path, changed: int, shapes: tuple[object, ...]) -> BodyDescription:
    return Document.read(path).validated(BodyDescription)
