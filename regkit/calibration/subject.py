"""The outcome of a calibration, and whether it can be believed."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from regkit.body import BodyDescription
from regkit.body.proportions import Proportions
from regkit.calibration.frames import Looks, distances
from regkit.calibration.shape import Shape
from regkit.system.arrays import Array
from regkit.system.errors import DataError

FARTHEST = 0.015
"""A body whose surface is farther from most data, as a part of its size, was not found."""

EXTREME = 1.25
"""Nor was one with a bone so many times longer or shorter than the template's at the same size."""

FAR = 0.03
"""Points farther from the surface, as a part of the size, can hardly be those of the body."""


@dataclass(frozen=True)
class Subject:
    """The person or hand that was seen.

    Attributes:
        description: The template with the subject's proportions, at the subject's size.
        proportions: By how much they differ from the template's.
        frames: In how many frames the subject was looked at.
        distance: Median distance of the data in these to the surface [m].
        strange: Share of the data that are so far from it that they can hardly be the subject's.
    """

    description: BodyDescription
    proportions: Proportions
    frames: int
    distance: float
    strange: float

    @classmethod
    def found(cls, shape: Shape, x: Array, looks: Looks, recording: str) -> Subject:
        """The subject whose shape is the vector x (1 + 2 G), seen in frames of a recording.

        Raises:
            DataError: If no body is like that, or the data are elsewhere.
        """
        body = shape.body(x)
        gaps = distances(body, looks)
        off = float(np.median(gaps))
        try:
            check(shape, x, off)
        except DataError as error:
            raise error.at(recording) from None
        return cls(
            description=_named(shape.description(x), recording, len(looks.poses)),
            proportions=shape.proportions(x),
            frames=len(looks.poses),
            distance=off,
            strange=float((gaps > FAR * body.size).mean()),
        )


def _named(description: BodyDescription, recording: str, frames: int) -> BodyDescription:
    """Returns the description, which says where its proportions come from."""
    source = f"Lengths and girths: fitted to {frames} frames of the recording {recording}"
    return description.model_copy(
        update={
            "title": f"{description.title}; with the proportions seen in {recording}",
            "sources": (*description.sources, source),
        }
    )


def check(shape: Shape, x: Array, off: float) -> None:
    """Refuse proportions that no subject has, which come of a start or a track that went wrong.

    Raises:
        DataError: If the surface is far from the data, or a bone's length is extreme.
    """
    cure = "the body was not found; give its size or a start, or take another recording"
    size = shape.description(x).size.value
    if off > FARTHEST * size:
        raise DataError(f"the body's surface lies {100.0 * off:.1f} cm from the data: {cure}")
    lengths = x[1 : 1 + len(shape.groups.names)]
    worst = int(np.abs(lengths).argmax())
    if abs(lengths[worst]) > np.log(EXTREME):
        raise DataError(
            f"'{shape.groups.names[worst]}' came out {np.exp(lengths[worst]):.2f} times as long as "
            f"in the template, all else being scaled: {cure}"
        )
