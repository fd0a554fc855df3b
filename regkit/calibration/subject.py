"""The outcome of a calibration and its plausibility."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from regkit.body import Body, BodyDescription, BodyFit
from regkit.body.proportions import Proportions
from regkit.body.verdict import frame_verdicts
from regkit.calibration.frames import Looks, distances
from regkit.calibration.shape import Shape
from regkit.system.arrays import Array
from regkit.system.errors import NotFoundError
from regkit.tracking import Verdict

FARTHEST = 0.015
"""A fit has failed if the median distance of the data exceeds this fraction of the body's size."""

EXTREME = 1.25
"""A fit has failed if a bone's length differs by more than this factor from the scaled template."""

FAR = 0.03
"""Points farther from the surface than this fraction of the size are hardly the body's."""

SLACK = 1.05
"""A fit has failed if the size is beyond the template's range by more than this factor."""

ADVICE = "the body was not found; give its size or a start, or use another recording"


@dataclass(frozen=True)
class Subject:
    """The person or hand in a recording.

    Attributes:
        description: The template with the subject's proportions, at the subject's size.
        proportions: Ratios of the subject's proportions to the template's.
        frames: Number of frames used for the fit.
        distance: Median distance of their data to the surface [m].
        strange: Fraction of the data too far from the surface to be the subject's.
        verdict: Whether the body was found in the frames, on average: found or doubtful.
    """

    description: BodyDescription
    proportions: Proportions
    frames: int
    distance: float
    strange: float
    verdict: Verdict

    @classmethod
    def found(cls, shape: Shape, x: Array, looks: Looks, recording: str) -> Subject:
        """Returns the subject with the shape parameters x (1 + 2 G).

        Args:
            shape: The parametrised template.
            x: Shape parameters, (1 + 2 G).
            looks: The frames used for the fit.
            recording: Name of the recording.

        Raises:
            NotFoundError: If the proportions are implausible, the data are far from the surface, or
                the body is lost in the frames.
        """
        body = shape.body(x)
        gaps = distances(body, looks)
        off = float(np.median(gaps))
        verdict = _verdict(body, looks)
        try:
            check(shape, x, off)
            if verdict is Verdict.LOST:
                raise NotFoundError(f"the data and the body do not cover each other: {ADVICE}")
        except NotFoundError as error:
            raise error.at(recording) from None
        return cls(
            description=_named(shape.description(x), recording, len(looks.poses)),
            proportions=shape.proportions(x),
            frames=len(looks.poses),
            distance=off,
            strange=float((gaps > FAR * body.size).mean()),
            verdict=verdict,
        )


def _verdict(body: Body, looks: Looks) -> Verdict:
    """Returns the verdict of the mean shares over the frames."""
    fits = [
        BodyFit.of(body, pose, cloud.points)
        for cloud, pose in zip(looks.clouds, looks.poses, strict=True)
    ]
    shares = (
        np.array([[getattr(fit, name) for fit in fits]]).mean(axis=1)
        for name in ("inlier_share", "coverage", "misfit", "relief")
    )
    return frame_verdicts(np.ones(1), *shares)[0]


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
        NotFoundError: If the surface is far from the data, the size is beyond the template's range,
            or a bone's length is extreme.
    """
    size = shape.description(x).size
    smallest, largest = shape.template.size.range
    if not smallest / SLACK <= size.value <= SLACK * largest:
        raise NotFoundError(
            f"its {size.name} came out as {size.value:.3g} m, and the template's range is "
            f"{smallest:.3g} to {largest:.3g} m: {ADVICE}, or widen size.range in the template"
        )
    if off > FARTHEST * size.value:
        raise NotFoundError(f"the body's surface lies {100.0 * off:.1f} cm from the data: {ADVICE}")
    lengths = x[1 : 1 + len(shape.groups.names)]
    worst = int(np.abs(lengths).argmax())
    if abs(lengths[worst]) > np.log(EXTREME):
        raise NotFoundError(
            f"'{shape.groups.names[worst]}' came out {np.exp(lengths[worst]):.2f} times as long as "
            f"in the scaled template: {ADVICE}"
        )
