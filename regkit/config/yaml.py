"""YAML input with line numbers, and readable YAML output."""

from __future__ import annotations

from io import StringIO
from pathlib import Path
from typing import Any

from ruamel.yaml import YAML
from ruamel.yaml.comments import CommentedMap, CommentedSeq
from ruamel.yaml.error import MarkedYAMLError, YAMLError

from regkit.config.changes import Location
from regkit.config.model import Text
from regkit.system.errors import ConfigError


def read_mapping(text: str, path: Path) -> tuple[dict[str, Any], dict[Location, str]]:
    """Returns the mapping of a YAML 1.2 file, and the ``file:line`` of each of its values.

    Args:
        text: The file's content.
        path: The file, for messages and for the folder of its strings.

    Raises:
        ConfigError: If it is not YAML, repeats a key, or does not hold a mapping.
    """
    tree = _parsed(text, str(path))
    if not isinstance(tree, CommentedMap):
        raise ConfigError("the file must hold a mapping of fields (name: value)", place=f"{path}:1")
    places: dict[Location, str] = {(): f"{path}:1"}
    return _located(tree, (), path, places), places


def yaml_value(text: str) -> Any:
    """Returns a YAML value written in one line, such as the value of a setting.

    Raises:
        ConfigError: If it is not YAML.
    """
    return _plain(_parsed(text, None))


def yaml_text(data: Any) -> str:
    """Returns ``data`` as readable YAML."""
    stream = StringIO()
    yaml = YAML(typ="safe", pure=True)
    yaml.default_flow_style = False
    yaml.sort_base_mapping_type_on_output = False  # type: ignore[assignment]
    yaml.dump(data, stream)
    return stream.getvalue()


def yaml_data(text: str, place: str) -> Any:
    """Returns the data of a text by ``yaml_text``.

    Args:
        text: The YAML.
        place: Source of the text, for messages.

    Raises:
        ConfigError: If it is not YAML.
    """
    return _plain(_parsed(text, place))


def _parsed(text: str, place: str | None) -> Any:
    """Returns the tree of a text; errors name the line after ``place``."""
    try:
        return YAML(typ="rt").load(text)
    except MarkedYAMLError as error:
        reason = (error.problem or "not YAML").splitlines()[0]
        line = f":{error.problem_mark.line + 1}" if error.problem_mark else ""
        raise ConfigError(f"not valid YAML: {reason}", place=place and place + line) from None
    except YAMLError as error:
        raise ConfigError(f"not valid YAML: {str(error).splitlines()[0]}", place=place) from None


def _located(node: Any, location: Location, path: Path, places: dict[Location, str]) -> Any:
    """Returns ``node`` without ruamel's types, and adds its lines to ``places``."""
    if isinstance(node, CommentedMap):
        for key in node:
            line = node.lc.data[key][0] if key in (node.lc.data or {}) else node.lc.line
            places[*location, key] = f"{path}:{line + 1}"
        return {str(key): _located(node[key], (*location, key), path, places) for key in node}
    if isinstance(node, CommentedSeq):
        for index in range(len(node)):
            places[*location, index] = f"{path}:{node.lc.item(index)[0] + 1}"
        return [_located(item, (*location, index), path, places) for index, item in enumerate(node)]
    if isinstance(node, str):
        return Text(node, path.parent.absolute())
    return _plain(node)


def _plain(value: Any) -> Any:
    """Returns ``value`` without ruamel's types."""
    if isinstance(value, dict):
        return {key: _plain(item) for key, item in value.items()}
    if isinstance(value, list):
        return [_plain(item) for item in value]
    if isinstance(value, float):
        return float(value)
    if isinstance(value, int) and not isinstance(value, bool):
        return int(value)
    return value
