"""Validation of the metrics of a track, as written and as read."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import fields
from functools import cache
from typing import Any, get_type_hints

from pydantic import BaseModel, ConfigDict, ValidationError, create_model

from regkit.metrics.measure import Measure
from regkit.system.errors import DataError

ALWAYS = (
    "frames",
    "unconverged_frames",
    "frames_without_data",
    "evaluations_per_frame",
    "preprocessing_ms",
    "fps",
    "verdict",
)
"""Metrics that every track has, with and without reference joints."""

COUNTS = ("frames", "lost_frames", "unconverged_frames", "frames_without_data", "lost_at_end")
"""Metrics of one track that are whole numbers, and at most the number of frames."""


def checked_measure(data: Any, *, place: str) -> Measure:
    """Returns the metrics of one track.

    Args:
        data: The metrics by name.
        place: The file, for messages.

    Raises:
        DataError: If a metric is unknown, missing, or not one that a track can have.
    """
    try:
        measure = Measure(**dict(_model().model_validate(data)))
    except ValidationError as error:
        first = error.errors(include_url=False)[0]
        name = ".".join(map(str, first["loc"][:1])) or "it"
        shown = f"; it is {first['input']!r}"[:100] if first["type"] != "missing" else ""
        message = first["msg"][0].lower() + first["msg"][1:]
        raise DataError(f"damaged: {name}: {message}{shown}", place=place) from None
    for problem in _problems(measure):
        raise DataError(f"damaged: {problem}", place=place)
    return measure


def _problems(measure: Measure) -> Iterator[str]:
    for name in ALWAYS:
        if getattr(measure, name) is None:
            yield f"{name} is null, and every track has it"
    for name in COUNTS:
        value = getattr(measure, name)
        if value is not None and (value % 1.0 or value > (measure.frames or 0.0)):
            yield f"{name} is {value:g} of {measure.frames:g} frames"


@cache
def _model() -> type[BaseModel]:
    """Returns a model of the fields: no unknown name, no text for a number, nothing infinite."""
    strict = ConfigDict(strict=True, extra="forbid", allow_inf_nan=False)
    hints = get_type_hints(Measure, include_extras=True)
    given: dict[str, Any] = {field.name: (hints[field.name], ...) for field in fields(Measure)}
    return create_model("Measure", __config__=strict, **given)
