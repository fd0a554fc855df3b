"""Validation of a field's value into the plug-in that it describes."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any, Protocol

from pydantic import BaseModel, ValidationError
from pydantic_core import PydanticCustomError

from regkit.config.changes import with_changes
from regkit.config.preset import preset
from regkit.system.errors import PluginError, RegkitError
from regkit.system.plugin_code import described, raised_at


class Slot(Protocol):
    """An abstract plug-in as the type of a field."""

    group: str
    former_group: str | None

    def available(self) -> Mapping[str, object]:
        """Returns the kinds by name."""

    def load(self, kind: str) -> type[BaseModel]:
        """Returns the plug-in of a kind."""


def plugin_of(slot: Slot, value: Any) -> BaseModel:
    """Returns the plug-in that data describe: a kind, or a mapping with a ``kind`` or ``preset``.

    Raises:
        PydanticCustomError: If the plug-in or preset does not exist.
        ValidationError: If one of its fields is invalid.
    """
    if isinstance(value, str):
        value = {"kind": value}
    try:
        if isinstance(value, dict) and isinstance(value.get("preset"), str):
            value = _changed(slot, value["preset"], value)
        kind = value.get("kind") if isinstance(value, dict) else None
        if not isinstance(kind, str):
            raise PydanticCustomError(
                "plugin_kind",
                "expected a name or a mapping with a 'kind' (installed: {names})",
                {"names": ", ".join(slot.available())},
            )
        plugin = slot.load(kind)
    except RegkitError as error:
        raise PydanticCustomError("plugin_error", "{error}", {"error": str(error)}) from error
    try:
        return plugin.model_validate(value)
    except (ValidationError, RegkitError, RecursionError):
        raise
    # pydantic lets other exceptions of a plug-in's own validators pass.
    except Exception as error:
        raise PydanticCustomError(
            "plugin_error",
            "the plug-in '{kind}' fails at {place}: {reason}",
            {"kind": kind, "place": raised_at(error), "reason": described(error)},
        ) from error


def _changed(slot: Slot, name: str, changes: Mapping[str, Any]) -> dict[str, Any]:
    """Returns a preset with changes, which must keep its kind."""
    base = _whole(slot, name)
    if changes.get("kind", base["kind"]) != base["kind"]:
        raise PluginError(
            f"the preset '{name}' is of the kind '{base['kind']}', which cannot be changed in it; "
            "leave 'kind' out"
        )
    return with_changes(base, {key: part for key, part in changes.items() if key != "preset"})


def _whole(slot: Slot, name: str) -> dict[str, Any]:
    """Returns the data of a preset, which must be valid by itself; errors name its own file."""
    document = preset(slot.group, name)
    kind = document.data.get("kind")
    if not isinstance(kind, str):
        raise PluginError("a preset must name its kind", place=document.place(()))
    document.validated(slot.load(kind))
    return document.data
