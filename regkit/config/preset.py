"""Presets: configurations of plug-ins in YAML files, used by name and changed in places."""

from __future__ import annotations

from pathlib import Path

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
