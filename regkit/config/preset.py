"""Presets: configurations of plug-ins in YAML files, used by name and changed in places."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path
from typing import Any

from regkit.config.document import Document
from regkit.config.installed import Installed, installed
from regkit.config.model import Text, did_you_mean
from regkit.system.errors import PluginError

YAML = (".yaml", ".yml")
"""How the name of a file ends that holds a preset."""


def presets_of(group: str) -> dict[str, Installed]:
    """The presets of a group of plug-ins by name: entry points to the paths of YAML files."""
    return installed(f"{group}.presets")


def preset_file(group: str, name: str) -> Path:
    """The file of a preset.

    Args:
        group: Of the plug-in that it configures.
        name: Of an installed preset, or a path that ends with ``.yaml``.

    Raises:
        PluginError: If there is none of that name, or it is broken.
    """
    if Path(name).suffix.lower() in YAML:
        folder = name.folder if isinstance(name, Text) else Path.cwd()
        return folder / Path(name).expanduser()
    presets = presets_of(group)
    if name not in presets:
        raise PluginError(
            f"no preset '{name}' (installed: {', '.join(presets)}; or name a .yaml file)"
            + did_you_mean(name, list(presets))
        )
    return Path(presets[name].load("preset"))


def preset(group: str, name: str) -> Document:
    """The document of a preset.

    Raises:
        RegkitError: If there is no such preset, or its file is no YAML mapping.
    """
    return Document.read(preset_file(group, name))


def changed(base: Mapping[str, Any], value: Mapping[str, Any]) -> dict[str, Any]:
    """A preset's configuration with all that stands beside the preset's name."""
    return _merged(base, {key: part for key, part in value.items() if key != "preset"})


def _merged(base: Mapping[str, Any], changes: Mapping[str, Any]) -> dict[str, Any]:
    """``base`` with ``changes`` in it."""
    return dict(base) | {key: _changed(base.get(key), new, key) for key, new in changes.items()}


def _changed(old: Any, new: Any, key: str) -> Any:
    """A value after a change: mappings of one kind and items of lists change, the rest is new."""
    if not isinstance(new, dict):
        return new
    if isinstance(old, str):
        old = {"kind": old}
    if isinstance(old, dict) and new.get("kind", old.get("kind")) == old.get("kind"):
        return _merged(old, new)
    if isinstance(old, list) and new and all(index.isdecimal() for index in new):
        return _with_items(old, new, key)
    return new


def _with_items(old: list[Any], new: Mapping[str, Any], key: str) -> list[Any]:
    """A list of which some items, named by their numbers, are changed."""
    items = list(old)
    for index, item in new.items():
        if int(index) >= len(items):
            raise PluginError(
                f"{key} is a list of {len(items)} in the preset, whose items are named by numbers "
                f"from 0; there is no item '{index}'"
            )
        items[int(index)] = _changed(items[int(index)], item, f"{key}.{index}")
    return items
