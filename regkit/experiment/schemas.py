"""JSON Schemas of everything that users write in YAML."""

from __future__ import annotations

from typing import Any

from pydantic import BaseModel, TypeAdapter
from pydantic.json_schema import GenerateJsonSchema, JsonSchemaValue
from pydantic_core import core_schema

from regkit.body import BodyDescription
from regkit.experiment.sweeps.sweep import SweptExperiment
from regkit.interfaces import AlignmentStart, Dataset, Method, Source
from regkit.skeleton import SkeletonDescription


def schemas() -> dict[str, dict[str, Any]]:
    """Returns each schema by the name of its file."""
    return {
        "experiment": schema_of(SweptExperiment),
        "template": schema_of(BodyDescription),
        "skeleton": schema_of(SkeletonDescription),
        "method": _whole(schema_of(Method), "A method as a file: a preset."),
        "alignment_start": _whole(schema_of(AlignmentStart), "A start of alignments as a file."),
        "dataset": _whole(schema_of(Dataset), "A dataset as a file: a preset."),
        "source": _whole(schema_of(Source), "A source as a file: a preset, and an address."),
    }


def schema_of(model: type[BaseModel]) -> dict[str, Any]:
    """Returns the JSON Schema of a model.

    Raises:
        PydanticInvalidForJsonSchema: If a field has a type without a JSON form.
    """
    schema = TypeAdapter(model).json_schema(schema_generator=_ForEditors)
    return {"$schema": _ForEditors.schema_dialect, **schema}


def _whole(schema: dict[str, Any], description: str) -> dict[str, Any]:
    """Returns the schema of a file that must name its kind, from the schema of a slot."""
    definitions = schema.get("$defs", {})
    # pydantic moves a slot to the definitions only if it is used more than once.
    slot = definitions[schema["$ref"].rpartition("/")[2]] if "$ref" in schema else schema
    (named,) = (form for form in slot["anyOf"] if "oneOf" in form)
    return {
        "$schema": schema["$schema"],
        "description": description,
        **named,
        "$defs": definitions,
    }


class _ForEditors(GenerateJsonSchema):
    """Schemas with descriptions of fields but without titles, which only repeat the names."""

    def field_title_should_be_set(self, schema: Any) -> bool:
        """Never."""
        return False

    def tagged_union_schema(self, schema: core_schema.TaggedUnionSchema) -> JsonSchemaValue:
        """Makes the discriminator of each alternative required, even if it has a default."""
        union = super().tagged_union_schema(schema)
        tag = schema["discriminator"]
        return {**union, "type": "object", "required": [tag]} if isinstance(tag, str) else union

    def dict_schema(self, schema: core_schema.DictSchema) -> JsonSchemaValue:
        """Forbids keys that do not match the type of a mapping's keys."""
        mapping = super().dict_schema(schema)
        return (
            {**mapping, "additionalProperties": False}
            if "patternProperties" in mapping
            else mapping
        )
