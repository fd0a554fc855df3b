"""The JSON Schema of a slot: what an editor offers where a plug-in is asked for."""

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
"""How the name of a preset ends that is a file."""

_BEGUN: ContextVar[frozenset[str]] = ContextVar("begun", default=frozenset())
"""The groups whose schemas are being made, for a plug-in may hold another of its own group."""


def slot_schema(slot: Slot, handler: GetJsonSchemaHandler) -> JsonSchemaValue:
    """A plug-in's name if it needs nothing else, a mapping with its kind, or a changed preset.

    A broken plug-in or preset is left out: it must not harm those who never name it.
    """
    begun = _BEGUN.get()
    if slot.group in begun:
        return {}  # The outer call, which has begun it, puts the whole in this place.
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
    """The plug-ins that can be imported and described, by kind, and what describes them."""
    found = {}
    for kind in slot.available():
        try:
            plugin = slot.load(kind)
            found[kind] = plugin, _option(plugin, handler)
        except (PluginError, PydanticInvalidForJsonSchema):
            continue
    return found


def _option(plugin: type[BaseModel], handler: GetJsonSchemaHandler) -> JsonSchemaValue:
    """The schema of a plug-in that is named by its kind."""
    schema = handler.resolve_ref_schema(handler(plugin.__pydantic_core_schema__))
    required = [name for name in _required(plugin) if name != "kind"]
    return {**schema, "required": ["kind", *required]}


def _required(plugin: type[BaseModel]) -> list[str]:
    return [name for name, field in plugin.model_fields.items() if field.is_required()]


def _preset(slot: Slot, name: str, handler: GetJsonSchemaHandler) -> JsonSchemaValue | None:
    """A preset by its name, and what may be changed in it."""
    try:
        # Plain texts, for those of a file carry its folder along.
        data = json.loads(json.dumps(preset(slot.group, name).data, default=str))
        changes = _changes(slot, data, handler)
    except (RegkitError, PydanticInvalidForJsonSchema):
        return None
    changes["properties"] = {"preset": {"type": "string", "const": name}, **changes["properties"]}
    return {**changes, "required": ["preset"], "title": f"preset {name}"}


def _changes(slot: Slot, old: Any, handler: GetJsonSchemaHandler) -> JsonSchemaValue:
    """What may be changed in the plug-in that a preset names, by its kind or with its fields."""
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
    """The schema ``whole`` of a model of which nothing is required and parts may be partial."""
    properties = {}
    for name, schema in whole["properties"].items():
        old = data.get(name)
        # What holds without a change is what the preset says.
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
    """The model that a field holds, or may hold."""
    for one in (annotation, *get_args(annotation)):
        if inspect.isclass(one) and issubclass(one, BaseModel):
            return one
    return None
