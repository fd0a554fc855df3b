"""The configuration of an experiment with all defaults filled in."""

from __future__ import annotations

from typing import Any

from pydantic import BaseModel
from pydantic_core import PydanticSerializationError, to_jsonable_python

from regkit.experiment.experiment import Experiment
from regkit.system.errors import ConfigError


def resolved(experiment: Experiment) -> dict[str, Any]:
    """Returns the experiment as JSON.

    Raises:
        ConfigError: If a plug-in has a field of a type without a YAML form; the message names it.
    """
    try:
        return experiment.model_dump(mode="json")
    except PydanticSerializationError as error:
        raise ConfigError(
            f"it cannot be written to config.yaml ({error}); use types with a YAML form",
            place=_unwritable(experiment),
        ) from None


def _unwritable(value: Any, place: str = "") -> str:
    """Returns the path to the innermost value that cannot be written."""
    parts: dict[Any, Any]
    if isinstance(value, BaseModel):
        parts = {name: getattr(value, name) for name in type(value).model_fields}
    elif isinstance(value, dict):
        parts = value
    elif isinstance(value, list | tuple):
        parts = dict(enumerate(value))
    else:
        return place
    for name, part in parts.items():
        try:
            to_jsonable_python(part)
        except PydanticSerializationError:
            return _unwritable(part, f"{place}.{name}" if place else str(name))
    return place
