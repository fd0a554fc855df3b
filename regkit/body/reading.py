"""Cached reading of template files."""

from __future__ import annotations

from functools import lru_cache
from pathlib import Path
from typing import Any, TypeVar

from regkit.body.description import BodyDescription
from regkit.body.shapes import ParametricShape
from regkit.config.document import Document
from regkit.config.model import Model
from regkit.config.registry import registered

M = TypeVar("M", bound=Model)


def description_in(path: Path) -> BodyDescription:
    """Returns the template in a YAML file; see ``validated_in``."""
    return validated_in(path, BodyDescription)


def validated_in(path: Path, model: type[M]) -> M:
    """Returns a model with shapes in a YAML file.

    The result is cached until the file or the set of registered shape models, which validate it,
    changes.

    Raises:
        RegkitError: If the file is missing or invalid.
    """
    changed = path.stat().st_mtime_ns if path.is_file() else 0
    found: M = _read(path, changed, tuple(registered(ParametricShape.group).items()), model)
    return found


@lru_cache(maxsize=32)
def _read(path: Path, changed: int, shapes: tuple[object, ...], model: type[Model]) -> Any:
    return Document.read(path).validated(model)
