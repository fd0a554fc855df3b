"""Which plug-in is taken where none is named: installed distributions declare it."""

from __future__ import annotations

from regkit.config.installed import installed
from regkit.system.errors import PluginError

GROUP = "regkit.defaults"
"""Entry points whose names say what for, and whose values are those of the plug-in or preset."""


def default_name(group: str, purpose: str = "") -> str:
    """The name of the plug-in or preset that a group takes where none is named.

    Nothing is imported: the default is the plug-in or preset that has the same value as the entry
    point ``GROUP`` of the name ``trackers``, or ``templates.file`` for a purpose.

    Raises:
        PluginError: If there is none, or two distributions declare one.
    """
    name = group.removeprefix("regkit.") + (f".{purpose}" if purpose else "")
    declared = installed(GROUP).get(name)
    if declared is None:
        raise PluginError(f"no default '{name}' is installed ({GROUP}); name one")
    if len(declared.points) > 1:
        raise PluginError(f"{declared.versions} both declare the default '{name}'; name one")
    value = declared.points[0].value
    for known in (f"{group}.presets", group):
        for kind, found in installed(known).items():
            if any(point.value == value for point in found.points):
                return kind
    raise PluginError(f"the default '{name}' ({value}) is no plug-in and no preset of {group}")
