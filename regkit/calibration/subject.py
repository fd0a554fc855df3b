"""The outcome of a calibration and its plausibility."""

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
"""A fit has failed if the median distance of the data exceeds this fraction of the body's size."""

EXTREME = 1.25
"""A fit has failed if a bone's length differs by more than this factor from the scaled template."""

FAR = 0.03
"""Points farther from the surface than this fraction of the size are hardly the body's."""


@dataclass(frozen=True)
class Subject:
    """The person or hand in a recording.

    Attributes:
        description: The template with the subject's proportions, at the subject's size.
        proportions: Ratios of the subject's proportions to the template's.
        frames: Number of frames used for the fit.
        distance: Median distance of their data to the surface [m].
        strange: Fraction of the data too far from the surface to be the subject's.
    """

    description: BodyDescription
    proportions: Proportions
    frames: int
    distance: float
    strange: float

    @classmethod
    def found(cls, shape: Shape, x: Array, looks: Looks, recording: str) -> Subject:
        """Returns the subject with the shape parameters x (1 + 2 G).

        Args:
            shape: The parametrised template.
            x: Shape parameters, (1 + 2 G).
            looks: The frames used for the fit.
            recording: Name of the recording.

        Raises:
            DataError: If the proportions are implausible or the data are far from the surface.
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
    """Returns the description with the origin of its proportions in title and sources."""
    source = f"Lengths and girths: fitted to {frames} frames of the recording {recording}"
    return description.model_copy(
        update={
            "title": f"{description.title}; with the proportions seen in {recording}",
            "sources": (*description.sources, source),
        }
    )


def check(shape: Shape, x: Array, off: float) -> None:
    """Checks that proportions are plausible; a failed start or track makes them implausible.

    Args:
        shape: The parametrised template.
        x: Shape parameters, (1 + 2 G).
        off: Median distance of the data to the surface [m].

    Raises:
        DataError: If the surface is far from the data, or a bone's length is extreme.
    """
    advice = "the body was not found; give its size or a start, or use another recording"
    size = shape.description(x).size.value
    if off > FARTHEST * size:
        raise DataError(f"the body's surface lies {100.0 * off:.1f} cm from the data: {advice}")
    lengths = x[1 : 1 + len(shape.groups.names)]
    worst = int(np.abs(lengths).argmax())
    if abs(lengths[worst]) > np.log(EXTREME):
        raise DataError(
            f"'{shape.groups.names[worst]}' came out {np.exp(lengths[worst]):.2f} times as long as "
            f"in the scaled template: {advice}"
        )
