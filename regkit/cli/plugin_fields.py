"""The fields of one plug-in, and the file of one preset."""

from __future__ import annotations

import inspect

from rich.markup import escape
from rich.table import Table

from regkit.cli.console import output
from regkit.config.model import did_you_mean
from regkit.config.preset import preset_file, presets_of
from regkit.interfaces import SLOTS
from regkit.system.errors import PluginError


def print_fields(kind: str) -> None:
    """Prints the fields of all plug-ins, and the files of all presets, of a name.

    Raises:
        PluginError: If there is none, or it is broken.
    """
    named = [slot for slot in SLOTS if kind in slot.available()]
    presets = [slot for slot in SLOTS if kind in presets_of(slot.group)]
    for slot in presets:
        file = preset_file(slot.group, kind)
        output.print(f"# {file}")
        text = file.read_text(encoding="utf-8")
        output.print(text)
    if not named and not presets:
        kinds = [name for slot in SLOTS for name in (*slot.available(), *presets_of(slot.group))]
        hint = did_you_mean(kind, kinds) or "; `regkit plugins` lists all of them"
        raise PluginError(f"no plug-in '{kind}' in any group" + hint)
    for slot in named:
        found = slot.load(kind)
        table = Table("field", "default", "description", title=f"{slot.group}: {kind}")
        for name, field in found.model_fields.items():
            default = "required"
            if not field.is_required():
                default = str(field.get_default(call_default_factory=True, validated_data={}))
            table.add_row(
                name, escape(default), escape(" ".join((field.description or "").split()))
            )
        output.print(table)
        output.print(inspect.cleandoc(found.__doc__ or ""), soft_wrap=False)
