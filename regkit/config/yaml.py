"""YAML input with line numbers, and readable YAML output."""

from __future__ import annotations

from io import StringIO
from pathlib import Path
from typing import Any

from ruamel.yaml import YAML

from regkit.config.changes import Location
from regkit.config.model import Text
from regkit.config.yaml_nodes import Node, root_of
from regkit.config.yaml_source import check_printable, yaml_source
from regkit.system.errors import ConfigError


def read_mapping(path: Path) -> tuple[dict[str, Any], dict[Location, str]]:
    """Returns the mapping in a YAML 1.2 file, and the ``file:line`` of each of its values.

    Strings are ``Text`` and know the file's folder.

    Raises:
        ConfigError: If it is not YAML, repeats a key, exceeds a bound, or does not hold a mapping.
        DataError: If the file is missing or not text.
    """
    root = root_of(yaml_source(path), str(path))
    if root is None or not isinstance(root.content, dict):
        reason = "the file is empty; it" if root is None else "the file"
        line = 1 if root is None else root.line
        raise ConfigError(
            f"{reason} must hold a mapping of fields (name: value)", place=f"{path}:{line}"
        )
    places: dict[Location, str] = {(): f"{path}:1"}
    return _located(root, (), path, places), places


def yaml_value(text: str) -> Any:
    """Returns a YAML value written in one line, such as the value of a setting.

    Raises:
        RegkitError: If it is not YAML.
    """
    return yaml_data(text, None)


def yaml_data(text: str, place: str | None) -> Any:
    """Returns the data of a text, such as one by ``yaml_text``.

    Args:
        text: The YAML.
        place: Source of the text, for messages.

    Raises:
        RegkitError: If it is not YAML.
    """
    check_printable(text, place)
    root = root_of(text, place)
    return None if root is None else _plain(root)


def yaml_text(data: Any) -> str:
    """Returns ``data`` as readable YAML."""
    stream = StringIO()
    yaml = YAML(typ="safe", pure=True)
    yaml.default_flow_style = False
    yaml.sort_base_mapping_type_on_output = False  # type: ignore[assignment]
    yaml.dump(data, stream)
    return stream.getvalue()


def _located(node: Node, location: Location, path: Path, places: dict[Location, str]) -> Any:
    """Returns the data of a node, and adds the lines of its parts to ``places``."""
    if isinstance(node.content, dict):
        for key in node.content:
            places[*location, key.text] = f"{path}:{key.line}"
        return {
            key.text: _located(part, (*location, key.text), path, places)
            for key, part in node.content.items()
        }
    if isinstance(node.content, list):
        for index, part in enumerate(node.content):
            places[*location, index] = f"{path}:{part.line}"
        return [_located(one, (*location, i), path, places) for i, one in enumerate(node.content)]
    return Text(node.content, path.parent.absolute()) if isinstance(node.content, str) else (
        node.content
    )  # fmt: skip


def _plain(node: Node) -> Any:
    """Returns the data of a node."""
    if isinstance(node.content, dict):
        return {key.text: _plain(part) for key, part in node.content.items()}
    if isinstance(node.content, list):
        return [_plain(part) for part in node.content]
    return node.content
