"""JSON Schema of a slot, for completion in editors."""

from __future__ import annotations

import inspect
import json
from collections.abc import Mapping
from contextvars import ContextVar
from typing import Any, cast, get_args

from pydantic import BaseModel, GetJsonSchemaHandler
from pydantic.errors import PydanticInvalidForJsonSchema
from pydantic.json_schema import JsonSchemaValue

from regkit.config.preset import preset, presets_of
from regkit.config.slot import Slot
from regkit.system.errors import PluginError, RegkitError

PRESET_FILE = r"\.ya?ml$"
"""Pattern of a preset's file name."""

_BEGUN: ContextVar[frozenset[str]] = ContextVar("begun", default=frozenset())
"""Groups whose schemas are under construction; a plug-in may contain one of its own group."""


def slot_schema(slot: Slot, handler: GetJsonSchemaHandler) -> JsonSchemaValue:
    """Returns the schema of a slot's values: a plug-in's name, its mapping, or a changed preset.

    A name alone suffices for plug-ins without required fields. Broken plug-ins and presets are left
    out, so that they cannot harm users who never name them.
    """
    begun = _BEGUN.get()
    if slot.group in begun:
        return {}  # The outer call on the same group provides the whole schema.
    token = _BEGUN.set(begun | {slot.group})
    try:
        plugins = _working(slot, handler)
        names = [kind for kind, (plugin, _) in plugins.items() if not _required(plugin)]
        options = [option for _, option in plugins.values()]
        presets = [_preset(slot, name, handler) for name in presets_of(slot.group)]
    finally:
        _BEGUN.reset(token)
    file = {"type": "string", "pattern": PRESET_FILE, "description": "A preset of your own."}
    forms: list[JsonSchemaValue] = [
        {"type": "object", "required": ["kind"], "oneOf": options},
        *(found for found in presets if found is not None),
        {"type": "object", "required": ["preset"], "properties": {"preset": file}},
    ]
    return {"anyOf": [{"type": "string", "enum": names}, *forms] if names else forms}


def _working(
    slot: Slot, handler: GetJsonSchemaHandler
) -> dict[str, tuple[type[BaseModel], JsonSchemaValue]]:
    """Returns the plug-ins that can be imported and described, by kind, with their schemas."""
    found = {}
    for kind in slot.available():
        try:
            plugin = slot.load(kind)
            found[kind] = plugin, _option(plugin, handler)
        except (PluginError, PydanticInvalidForJsonSchema):
            continue
    return found


def _option(plugin: type[BaseModel], handler: GetJsonSchemaHandler) -> JsonSchemaValue:
    """Returns the schema of a plug-in's mapping with its kind."""
    schema = handler.resolve_ref_schema(handler(plugin.__pydantic_core_schema__))
    required = [name for name in _required(plugin) if name != "kind"]
    return {**schema, "required": ["kind", *required]}


def _required(plugin: type[BaseModel]) -> list[str]:
    return [name for name, field in plugin.model_fields.items() if field.is_required()]


def _preset(slot: Slot, name: str, handler: GetJsonSchemaHandler) -> JsonSchemaValue | None:
    """Returns the schema of a preset's name with its possible changes."""
    try:
        # Convert to plain strings: those from a file carry its folder.
        data = json.loads(json.dumps(preset(slot.group, name).data, default=str))
        changes = _changes(slot, data, handler)
    except (RegkitError, PydanticInvalidForJsonSchema):
        return None
    changes["properties"] = {"preset": {"type": "string", "const": name}, **changes["properties"]}
    return {**changes, "required": ["preset"], "title": f"preset {name}"}


def _changes(slot: Slot, old: Any, handler: GetJsonSchemaHandler) -> JsonSchemaValue:
    """Returns the schema of changes to a preset's plug-in, given by its kind or its fields."""
    data = {"kind": old} if isinstance(old, str) else old
    kind = data.get("kind")
    if not isinstance(kind, str):
        return {"type": "object", "properties": {}}  # A preset within a preset.
    plugin = slot.load(kind)
    return _partial(plugin, _option(plugin, handler), data, handler)


def _partial(
    model: type[BaseModel],
    whole: JsonSchemaValue,
    data: Mapping[str, Any],
    handler: GetJsonSchemaHandler,
) -> JsonSchemaValue:
    """Returns ``whole``, a model's schema, with no required fields and partial parts allowed."""
    properties = {}
    for name, schema in whole["properties"].items():
        old = data.get(name)
        # The preset's value is the default of its changes.
        shown = {**schema, "default": data[name]} if name in data else schema
        part = _model_of(model.model_fields[name].annotation)
        if part is None or not isinstance(old, (str, dict)):
            properties[name] = shown
            continue
        if "group" in vars(part):
            change = _changes(cast(Slot, part), old, handler)
        else:
            inner = handler.resolve_ref_schema(handler(part.__pydantic_core_schema__))
            change = _partial(part, inner, cast(Mapping[str, Any], old), handler)
        described = {key: shown[key] for key in ("description", "default") if key in shown}
        forms = {key: value for key, value in schema.items() if key not in described}
        properties[name] = {**described, "anyOf": [forms, change]}
    return {"type": "object", "additionalProperties": False, "properties": properties}


def _model_of(annotation: Any) -> type[BaseModel] | None:
    """Returns the model that a field holds, or may hold."""
    for one in (annotation, *get_args(annotation)):
        if inspect.isclass(one) and issubclass(one, BaseModel):
            return one
    return None
