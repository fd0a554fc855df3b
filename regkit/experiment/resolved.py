"""An experiment with every default filled in, as what can be written down."""

from __future__ import annotations

from typing import Any

from pydantic import BaseModel
from pydantic_core import PydanticSerializationError, to_jsonable_python

from regkit.experiment.experiment import Experiment
from regkit.system.errors import ConfigError


def resolved(experiment: Experiment) -> dict[str, Any]:
    """The experiment as JSON.

    Raises:
        ConfigError: If a plug-in has a field of a type that no YAML can hold; it says which.
    """
    try:
        return experiment.model_dump(mode="json")
    except PydanticSerializationError as error:
        raise ConfigError(
            f"it cannot be written to config.yaml ({error}); a plug-in's fields hold what YAML can",
            place=_unwritable(experiment),
        ) from None


def _unwritable(value: Any, place: str = "") -> str:
    """The way to the innermost part that cannot be written."""
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
