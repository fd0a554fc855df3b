"""Changes of nested data: one value at the end of a path, or a mapping of many.

Settings, sweeps and the changes of a preset all use these rules.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from typing import Any

from regkit.system.errors import ConfigError

Location = tuple[str | int, ...]
"""Path to a value: keys of mappings and indices of items."""


def with_value(
    data: Any, keys: Sequence[str], value: Any, at: Location = ()
) -> tuple[Any, Location]:
    """Returns ``data`` with ``value`` at the end of a path.

    Missing mappings are added, and a short form such as ``shape: gsog`` becomes a mapping.

    Args:
        data: A mapping; it is not modified.
        keys: The path; items of a list are given by their index, from 0.
        value: The new value.
        at: Location of ``data``, for messages.

    Returns:
        The changed data, and the value's location.

    Raises:
        ConfigError: If the path passes through a scalar, or a list has no such item.
    """
    if not keys:
        return value, at
    key, *rest = keys
    around = _long_form(data)
    if isinstance(around, list):
        index = _index(around, key, at)
        items = list(around)
        items[index], location = with_value(items[index], rest, value, (*at, index))
        return items, location
    if not isinstance(around, dict):
        raise ConfigError(f"{_dotted(at)} is {around!r}, which is neither a mapping nor a list")
    inner, location = with_value(around.get(key), rest, value, (*at, key))
    return {**around, key: inner}, location


def with_changes(data: dict[str, Any], changes: Mapping[str, Any]) -> dict[str, Any]:
    """Returns ``data`` with a mapping of changes.

    A mapping within the changes is merged into a mapping of the same kind; a mapping whose keys
    are integers changes items of a list; any other value replaces the previous one.

    Raises:
        ConfigError: If a list has no such item.
    """
    for keys, value in _single_values(data, dict(changes), ()):
        data, _ = with_value(data, keys, value)
    return data


def _single_values(
    old: Any, new: Any, keys: tuple[str, ...]
) -> Iterator[tuple[tuple[str, ...], Any]]:
    """Yields each new value with its path."""
    old = _long_form(old)
    if not (isinstance(new, dict) and _changes_parts(old, new)):
        yield keys, new
        return
    for key, part in new.items():
        if isinstance(old, dict):
            before = old.get(key)
        else:
            before = old[int(key)] if int(key) < len(old) else None
        yield from _single_values(before, part, (*keys, key))


def _changes_parts(old: Any, new: dict[str, Any]) -> bool:
    """Whether a mapping changes parts of the old value, rather than replacing it."""
    if isinstance(old, dict):
        return bool(new.get("kind", old.get("kind")) == old.get("kind"))
    return isinstance(old, list) and bool(new) and all(str(key).isdecimal() for key in new)


def _long_form(value: Any) -> Any:
    """Returns a plug-in's name as a mapping, null as an empty one, and others unchanged."""
    if isinstance(value, str):
        return {"kind": value}
    return {} if value is None else value


def _index(items: list[Any], key: str, at: Location) -> int:
    if str(key).isdecimal() and int(key) < len(items):
        return int(key)
    raise ConfigError(
        f"{_dotted(at)} is a list of {len(items)}, with items numbered from 0; there is "
        f"no item '{key}'"
    )


def _dotted(location: Location) -> str:
    return ".".join(map(str, location))
