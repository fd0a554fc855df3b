"""Files of joint maps, shipped or the user's."""

from __future__ import annotations

from functools import lru_cache
from pathlib import Path
from typing import Annotated, Any, TypeVar

from pydantic import BeforeValidator

from regkit.config.document import Document
from regkit.config.model import Model, Text, did_you_mean, path_in
from regkit.system.errors import ConfigError

M = TypeVar("M", bound=Model)

FOLDER = Path(__file__).resolve().parent / "maps"
"""Folder of the shipped maps."""


def _located(value: Any) -> Any:
    """Returns the absolute path of a user's file, or the name of a shipped map unchanged."""
    if not isinstance(value, str) or not value.endswith((".yaml", ".yml")):
        return value
    return str(path_in(value.folder if isinstance(value, Text) else Path.cwd(), value))


MapName = Annotated[str, BeforeValidator(_located)]
"""Name of a shipped map, or a YAML file relative to the file that names it."""


def shipped(group: str) -> list[str]:
    """Returns the names of the shipped maps of a ``group``: ``sources`` or ``bodies``."""
    return sorted(path.stem for path in (FOLDER / group).glob("*.yaml"))


def read_map(model: type[M], group: str, name: str) -> M:
    """Returns the shipped map of a name, or the map in a file.

    Raises:
        ConfigError: If the name is unknown, or the file is invalid.
        DataError: If the file is missing.
    """
    if name.endswith((".yaml", ".yml")):
        return Document.read(Path(name)).validated(model)
    known = shipped(group)
    if name not in known:
        raise ConfigError(
            f"no map '{name}' of {group} ships (there are: {', '.join(known)}); a file of "
            "your own must end in .yaml" + did_you_mean(name, known)
        )
    return _shipped(FOLDER / group / f"{name}.yaml").validated(model)


@lru_cache(maxsize=32)
def _shipped(path: Path) -> Document:
    return Document.read(path)
