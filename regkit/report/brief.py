"""Configurations in a line: what they are made of, and where one differs from the others."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from typing import Any

Path = tuple[str | int, ...]
Leaves = dict[Path, Any]


def flow(value: Any) -> str:
    """A value as YAML in one line; what is empty is left out, and a lone kind is its name."""
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
    """Each method in a line: the kinds of its parts, and values that another one has otherwise."""
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
    """The value less what says nothing."""
    if isinstance(value, Mapping):
        parts = {key: _pruned(one, (*path, key), own, all_leaves) for key, one in value.items()}
        return {key: part for key, part in parts.items() if part is not None}
    if isinstance(value, list | tuple):
        return [_pruned(one, (*path, index), own, all_leaves) for index, one in enumerate(value)]
    return value if path[-1] == "kind" or _tells(path, own, all_leaves) else None


def _tells(path: Path, own: Leaves, all_leaves: list[Leaves]) -> bool:
    """Whether a method whose parts have the same kinds has another value there."""
    kinds = [(*path[:depth], "kind") for depth in range(len(path))]
    return any(
        other[path] != own[path]
        for other in all_leaves
        if path in other and all(other.get(kind) == own.get(kind) for kind in kinds)
    )
