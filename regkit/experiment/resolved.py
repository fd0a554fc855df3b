"""The configuration of an experiment with all defaults filled in."""

from __future__ import annotations

from typing import Any

from pydantic_core import PydanticSerializationError, to_jsonable_python

from regkit.config.parts import placed_parts
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
    for inner, part in placed_parts(value, place):
        try:
            to_jsonable_python(part)
        except PydanticSerializationError:
            return _unwritable(part, inner)
    return place
