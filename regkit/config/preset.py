"""Presets: named configurations of plug-ins in YAML files."""

from __future__ import annotations

from pathlib import Path

from regkit.config.document import Document
from regkit.config.installed import Installed, installed
from regkit.config.model import Text, did_you_mean, path_in
from regkit.system.errors import PluginError

YAML = (".yaml", ".yml")
"""Suffixes of preset files."""


def presets_of(group: str) -> dict[str, Installed]:
    """Returns the presets of a group by name: entry points that hold the paths of YAML files."""
    return installed(f"{group}.presets")


def preset_file(group: str, name: str) -> Path:
    """Returns the file of a preset.

    Args:
        group: Group of the plug-in that it configures.
        name: Name of an installed preset, or a path that ends with ``.yaml``.

    Raises:
        PluginError: If the preset does not exist, or is broken.
    """
    if Path(name).suffix.lower() in YAML:
        folder = name.folder if isinstance(name, Text) else Path.cwd()
        try:
            return path_in(folder, name)
        except ValueError as error:
            raise PluginError(str(error)) from None
    presets = presets_of(group)
    if name not in presets:
        raise PluginError(
            f"no preset '{name}' (installed: {', '.join(presets)}; or name a .yaml file)"
            + did_you_mean(name, list(presets))
        )
    return Path(presets[name].load("preset"))


def preset(group: str, name: str) -> Document:
    """Returns the document of a preset.

    Raises:
        RegkitError: If the preset does not exist, or its file is not a YAML mapping.
    """
    return Document.read(preset_file(group, name))
