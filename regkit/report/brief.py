"""One-line summaries of configurations: their parts, and the values in which they differ."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from typing import Any

Path = tuple[str | int, ...]
Leaves = dict[Path, Any]


def flow(value: Any) -> str:
    """Returns a value as YAML flow in one line.

    Empty parts are omitted, and a mapping with a kind only is written as its name.
    """
    if isinstance(value, Mapping):
        parts = {key: text for key, one in value.items() if (text := flow(one))}
        if list(parts) == ["kind"]:
            return parts["kind"]
        return (
            "{" + ", ".join(f"{key}: {text}" for key, text in parts.items()) + "}" if parts else ""
        )
    if isinstance(value, list | tuple):
        texts = [text for one in value if (text := flow(one))]
        return "[" + ", ".join(texts) + "]" if texts else ""
    if value is None:
        return ""
    if isinstance(value, bool):
        return str(value).lower()
    return f"{value:g}" if isinstance(value, float) else str(value)


def brief(methods: Mapping[str, Mapping[str, Any]]) -> dict[str, str]:
    """Returns a line for each method: the kinds of its parts, and values that differ.

    Args:
        methods: Configurations by name.
    """
    flat = {name: dict(_leaves(method, ())) for name, method in methods.items()}
    return {
        name: flow(_pruned(method, (), flat[name], list(flat.values())))
        for name, method in methods.items()
    }


def _leaves(value: Any, path: Path) -> Iterator[tuple[Path, Any]]:
    if isinstance(value, Mapping):
        for key, one in value.items():
            yield from _leaves(one, (*path, key))
    elif isinstance(value, list | tuple):
        for index, one in enumerate(value):
            yield from _leaves(one, (*path, index))
    else:
        yield path, value


def _pruned(value: Any, path: Path, own: Leaves, all_leaves: list[Leaves]) -> Any:
    """Returns the value without leaves that are the same in all comparable methods."""
    if isinstance(value, Mapping):
        parts = {key: _pruned(one, (*path, key), own, all_leaves) for key, one in value.items()}
        return {key: part for key, part in parts.items() if part is not None}
    if isinstance(value, list | tuple):
        return [_pruned(one, (*path, index), own, all_leaves) for index, one in enumerate(value)]
    return value if path[-1] == "kind" or _differs(path, own, all_leaves) else None


def _differs(path: Path, own: Leaves, all_leaves: list[Leaves]) -> bool:
    """Returns whether a method with the same kinds along the path has another value there."""
    kinds = [(*path[:depth], "kind") for depth in range(len(path))]
    return any(
        other[path] != own[path]
        for other in all_leaves
        if path in other and all(other.get(kind) == own.get(kind) for kind in kinds)
    )
