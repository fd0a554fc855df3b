"""Default plug-ins, as installed distributions declare them."""

from __future__ import annotations

from regkit.config.installed import installed
from regkit.system.errors import PluginError

GROUP = "regkit.defaults"
"""Entry points named by purpose, whose values are those of a plug-in or preset."""


def default_name(group: str, purpose: str = "") -> str:
    """Returns the name of the default plug-in or preset of a group.

    Nothing is imported: the default is the plug-in or preset with the same entry-point value as
    the entry point of ``GROUP`` named like ``trackers``, or ``templates.file`` for a purpose.

    Raises:
        PluginError: If there is no default, or two distributions declare one.
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
    raise PluginError(f"the default '{name}' ({value}) is not a plug-in or preset of {group}")
