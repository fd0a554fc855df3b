"""The outcome of a calibration and its plausibility."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from regkit.body import Body, BodyDescription, BodyFit
from regkit.body.verdict import frame_verdicts
from regkit.calibration.frames import Looks
from regkit.calibration.subject_shape import ADVICE, NOISE, SubjectShape, check_distance
from regkit.geometry.skinned_mesh import SkinnedMesh
from regkit.system.arrays import Array
from regkit.system.errors import NotFoundError
from regkit.tracking import Verdict

FAR = 0.03
"""Points farther from the surface than this fraction of the size, and than twice what noise alone
does, are hardly the body's."""

SLACK = 1.05
"""A fit has failed if the size is beyond the template's range by more than this factor."""


@dataclass(frozen=True)
class Subject:
    """The person or hand in a recording.

    Attributes:
        shape: What was varied.
        x: The shape that was found, (P,).
        description: The template with the subject's shape, at the subject's size.
        skin: Its mesh; None without one.
        frames: Number of frames used for the fit.
        distance: Median distance of their data to the surface [m].
        strange: Fraction of the data too far from the surface to be the subject's.
        verdict: Whether the body was found in the frames, on average: found or doubtful.
    """

    shape: SubjectShape
    x: Array
    description: BodyDescription
    skin: SkinnedMesh | None
    frames: int
    distance: float
    strange: float
    verdict: Verdict

    @classmethod
    def found(cls, shape: SubjectShape, x: Array, looks: Looks, recording: str) -> Subject:
        """Returns the subject with the shape x (P,).

        Args:
            shape: The template whose shape was varied.
            x: The shape, (P,).
            looks: The frames used for the fit.
            recording: Name of the recording.

        Raises:
            NotFoundError: If the shape is implausible, the data are far from the surface, or
                the body is lost in the frames.
        """
        body = shape.body(x)
        gaps = shape.gaps(x, looks)
        off = float(np.median(gaps))
        verdict = _verdict(body, looks)
        try:
            check(shape, x, off)
            if verdict is Verdict.LOST:
                raise NotFoundError(f"the data and the body do not cover each other: {ADVICE}")
        except NotFoundError as error:
            raise error.at(recording) from None
        return cls(
            shape=shape,
            x=x,
            description=_named(shape.description(x), recording, len(looks.poses)),
            skin=shape.skin(x),
            frames=len(looks.poses),
            distance=off,
            strange=float((gaps > max(FAR * body.size, 2.0 * NOISE)).mean()),
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


def check(shape: SubjectShape, x: Array, off: float) -> None:
    """Checks that a shape is plausible; a failed start or track makes it implausible.

    Args:
        shape: The template whose shape was varied.
        x: The shape, (P,).
        off: Median distance of the data to the surface [m].

    Raises:
        NotFoundError: If the surface is far from the data, the size is beyond the template's range,
            or the shape is extreme.
    """
    size = shape.description(x).size
    smallest, largest = shape.template.size.range
    if not smallest / SLACK <= size.value <= SLACK * largest:
        raise NotFoundError(
            f"its {size.name} came out as {size.value:.3g} m, and the template's range is "
            f"{smallest:.3g} to {largest:.3g} m: {ADVICE}, or widen size.range in the template"
        )
    check_distance(off, size.value)
    shape.check(x)
