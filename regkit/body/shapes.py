"""Validation of a template's ``shapes``, by list of primitives and by segment."""

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

from regkit.body.shape_keys import KEY, kind_of, named_keys
from regkit.body.shape_parameters import ShapeParameters, UncheckedParameters
from regkit.config.model import misplaced
from regkit.config.plugin import Plugin
from regkit.system.errors import PluginError


class ParametricShape(Plugin, ABC):
    """The part of a shape model that templates depend on."""

    group = "regkit.shapes"

    parameters: ClassVar[type[ShapeParameters] | None] = None
    """Parameters that a template can list for each primitive; None if the shape model always makes
    its primitives from the capsules or the mesh."""

    @classmethod
    def parameters_of(cls, kind: str) -> type[ShapeParameters] | None:
        """Returns the parameter class of a kind, or None if templates cannot list any.

        Raises:
            PluginError: If the shape model cannot be loaded, or does not name a parameter class.
        """
        found: Any = cls.load(kind).parameters
        if found is None:
            return None
        if inspect.isclass(found) and issubclass(found, ShapeParameters):
            return found
        raise PluginError(f"shape model '{kind}' must set 'parameters' to a ShapeParameters class")


class _ByKind:
    """Validation and JSON schema of ``shapes`` for pydantic."""

    @classmethod
    def __get_pydantic_core_schema__(cls, _: Any, __: GetCoreSchemaHandler) -> CoreSchema:
        return core_schema.no_info_plain_validator_function(
            _validated, metadata={"pydantic_js_functions": [cls._json_schema]}
        )

    @classmethod
    def _json_schema(cls, _: CoreSchema, handler: GetJsonSchemaHandler) -> JsonSchemaValue:
        """Returns a schema of the installed shape models and of unknown ones; skips broken ones."""
        properties, named = {}, {}
        for kind in ParametricShape.available():
            try:
                parameters = ParametricShape.parameters_of(kind)
                if parameters is not None:
                    listed = handler(_schema(parameters))
                    description = f"Primitives of the shape model '{kind}', by segment."
                    properties[kind] = {"description": description, **listed}
                    description = f"A named list of primitives of '{kind}', by segment."
                    named[named_keys(kind)] = {"description": description, **listed}
            except (PluginError, PydanticInvalidForJsonSchema):
                continue
        other = handler(_schema(dict[str, Any]))
        return {
            "type": "object",
            "properties": properties,
            "patternProperties": named,
            "additionalProperties": other,
            "propertyNames": {"pattern": KEY},
        }


Shapes = Annotated[dict[str, dict[str, tuple[ShapeParameters, ...]]], _ByKind]
"""The primitives of each list, by ``KIND`` of shape model or ``KIND/NAME``, on each segment."""


def _schema(parameters: Any) -> CoreSchema:
    """Returns the schema of one list: by segment, the parameters of each primitive."""
    return TypeAdapter(dict[str, tuple[parameters, ...]]).core_schema


def _validated(value: Any) -> dict[str, dict[str, tuple[ShapeParameters, ...]]]:
    """Returns the shapes, each list validated by the class of its shape model."""
    fields = {
        key: core_schema.typed_dict_field(_schema(_listed_of(key)))
        for key in (value if isinstance(value, Mapping) else ())
    }
    validator = SchemaValidator(core_schema.typed_dict_schema(fields))
    listed: dict[str, dict[str, tuple[ShapeParameters, ...]]] = validator.validate_python(value)
    return listed


def _listed_of(key: str) -> Any:
    """Returns the type of a list's parameters, unchecked if its shape model cannot be loaded."""
    try:
        kind = kind_of(key)
    except ValueError as error:
        raise misplaced(ParametricShape, str(error), key) from None
    try:
        parameters = ParametricShape.parameters_of(kind)
    except PluginError as error:
        return Annotated[UncheckedParameters, BeforeValidator(partial(_unchecked, key, str(error)))]
    if parameters is None:
        raise misplaced(ParametricShape, f"the shape model '{kind}' has no parameters", key)
    return parameters


def _unchecked(key: str, reason: str, value: Any) -> UncheckedParameters:
    if isinstance(value, UncheckedParameters):
        return value
    if not isinstance(value, Mapping):
        raise ValueError("a primitive is a mapping of its parameters")
    return UncheckedParameters(key=key, reason=reason, given=value)
