"""``shapes`` of a template: by the kind of shape model, then by segment."""

from __future__ import annotations

import inspect
from abc import ABC
from collections.abc import Mapping
from functools import partial
from typing import Annotated, Any, ClassVar

from pydantic import BeforeValidator, GetCoreSchemaHandler, GetJsonSchemaHandler, TypeAdapter
from pydantic.errors import PydanticInvalidForJsonSchema
from pydantic.json_schema import JsonSchemaValue
from pydantic_core import CoreSchema, SchemaValidator, core_schema

from regkit.body.shape_parameters import ShapeParameters, UncheckedParameters
from regkit.config.model import misplaced
from regkit.config.plugin import Plugin
from regkit.system.errors import PluginError


class ParametricShape(Plugin, ABC):
    """A shape model as far as templates know it."""

    group = "regkit.shapes"

    parameters: ClassVar[type[ShapeParameters] | None] = None
    """What a template can list of each of its primitives; without it the shape model makes them
    from the capsules or the mesh alone."""

    @classmethod
    def parameters_of(cls, kind: str) -> type[ShapeParameters] | None:
        """What a template can list of the primitives of a kind.

        Raises:
            PluginError: If the shape model cannot be loaded, or the class is none of parameters.
        """
        found: Any = cls.load(kind).parameters
        if found is None:
            return None
        if inspect.isclass(found) and issubclass(found, ShapeParameters):
            return found
        raise PluginError(f"shape model '{kind}' must set 'parameters' to a ShapeParameters class")


class _ByKind:
    """How pydantic validates and describes ``shapes``."""

    @classmethod
    def __get_pydantic_core_schema__(cls, _: Any, __: GetCoreSchemaHandler) -> CoreSchema:
        return core_schema.no_info_plain_validator_function(
            _validated, metadata={"pydantic_js_functions": [cls._json_schema]}
        )

    @classmethod
    def _json_schema(cls, _: CoreSchema, handler: GetJsonSchemaHandler) -> JsonSchemaValue:
        """Returns the installed shape models, and any other; a broken one is left out."""
        properties = {}
        for kind in ParametricShape.available():
            try:
                parameters = ParametricShape.parameters_of(kind)
                if parameters is not None:
                    listed = handler(_schema(parameters))
                    told = f"By segment, the primitives of the shape model '{kind}'."
                    properties[kind] = {"description": told, **listed}
            except (PluginError, PydanticInvalidForJsonSchema):
                continue
        other = handler(_schema(dict[str, Any]))
        return {"type": "object", "properties": properties, "additionalProperties": other}


Shapes = Annotated[dict[str, dict[str, tuple[ShapeParameters, ...]]], _ByKind]
"""The primitives of each kind of shape model on each segment."""


def _schema(parameters: Any) -> CoreSchema:
    """What is listed of one kind: by segment, the parameters of each primitive."""
    return TypeAdapter(dict[str, tuple[parameters, ...]]).core_schema


def _validated(value: Any) -> dict[str, dict[str, tuple[ShapeParameters, ...]]]:
    """Returns each kind as the class of its shape model checks it."""
    fields = {
        kind: core_schema.typed_dict_field(_schema(_listed_of(kind)))
        for kind in (value if isinstance(value, Mapping) else ())
    }
    validator = SchemaValidator(core_schema.typed_dict_schema(fields))
    listed: dict[str, dict[str, tuple[ShapeParameters, ...]]] = validator.validate_python(value)
    return listed


def _listed_of(kind: str) -> Any:
    """The type of what is listed of a kind; without its shape model it is kept as it stands."""
    try:
        parameters = ParametricShape.parameters_of(kind)
    except PluginError as error:
        return Annotated[UncheckedParameters, BeforeValidator(partial(_kept, kind, str(error)))]
    if parameters is None:
        raise misplaced(ParametricShape, f"the shape model '{kind}' has no parameters", kind)
    return parameters


def _kept(kind: str, reason: str, value: Any) -> UncheckedParameters:
    if isinstance(value, UncheckedParameters):
        return value
    if not isinstance(value, Mapping):
        raise ValueError("a primitive is a mapping of its parameters")
    return UncheckedParameters(kind=kind, reason=reason, given=value)
