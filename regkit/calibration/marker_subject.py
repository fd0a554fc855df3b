"""A template with the proportions of a person and the markers on the body, from a recording."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from regkit.body import Body, BodyDescription
from regkit.body.proportions import Proportions
from regkit.calibration.marker_problem import MarkerProblem
from regkit.calibration.marker_set import MarkerSet
from regkit.calibration.shape import Shape
from regkit.interfaces import Recording, Template
from regkit.observation import Frame, Observation
from regkit.search.landmark_fit import LandmarkFit
from regkit.skeleton import Pose
from regkit.start.landmarks import landmark_start
from regkit.system.arrays import Array
from regkit.system.errors import DataError, NotFoundError
from regkit.system.optional import one_blas_thread
from regkit.system.progress import working

FARTHEST = 0.03
"""A fit has failed if the markers are farther from the measured ones than this part of the size."""


@dataclass(frozen=True)
class MarkerSubject:
    """The outcome of a calibration by markers.

    Attributes:
        description: The template with the subject's proportions and the markers on it.
        proportions: Ratios of the subject's proportions to the template's.
        names: Names of the calibrated markers, (M,).
        moved: Distances of the markers' places from those in the marker set, (M,) [m].
        errors: Root mean square distance of each marker from the measured one, (M,) [m].
        frames: Number of frames used for the fit.
    """

    description: BodyDescription
    proportions: Proportions
    names: tuple[str, ...]
    moved: Array
    errors: Array
    frames: int

    @classmethod
    def of(
        cls, template: Template, markers: MarkerSet, recording: Recording, frames: int = 12
    ) -> MarkerSubject:
        """Returns the subject of a recording of markers.

        Args:
            template: Template with average proportions.
            markers: Rough places of the markers on it.
            recording: The recording.
            frames: Number of frames used for the fit, spread over the recording.

        Raises:
            RegkitError: If the recording lacks markers, or they do not fit.
        """
        with one_blas_thread(), working("fitting"):
            return _subject(template, markers, recording, frames)


def _subject(
    template: Template, markers: MarkerSet, recording: Recording, frames: int
) -> MarkerSubject:
    own = template.description()
    # What the fit does not need would be scaled again at every step.
    bare = own.model_copy(update={"shapes": {}, "mesh": None, "modes": None})
    whole, shape = markers.added_to(bare), Shape(bare)
    many = [_observed(frame) for frame in recording.frames()]
    try:
        start = landmark_start(
            lambda size: whole.body("subject", size), template.candidate_sizes(), many[0]
        )
    except DataError as error:
        raise error.at(recording.name) from None
    used = sorted({(len(many) - 1) * n // max(frames - 1, 1) for n in range(frames)})
    poses = _poses(start.body, start.pose, many)
    scale = start.body.size / own.size.value
    listed = [(name, *next(iter(one.items()))) for name, one in markers.markers.items()]
    problem = MarkerProblem(
        shape,
        np.array([start.body.skeleton.names.index(segment) for _, segment, _ in listed]),
        np.array([_measured(many[n], tuple(markers.markers)) for n in used]),
        scale * np.array([place for _, _, place in listed]),
    )
    x, places, found = problem.solved(shape.origin(start.body.size), [poses[n] for n in used])
    errors = _errors(problem, x, places, found)
    if np.median(errors) > FARTHEST * start.body.size:
        raise NotFoundError(
            f"half of the markers are more than {100.0 * np.median(errors):.0f} cm from the "
            "measured ones; is each marker on the segment that the marker set names, and is the "
            "upward axis right?",
            place=recording.name,
        )
    calibrated = MarkerSet(
        markers={
            name: {segment: tuple(place)}
            for (name, segment, _), place in zip(listed, places.tolist(), strict=True)
        }
    )
    return MarkerSubject(
        description=calibrated.added_to(Shape(own).description(x)),
        proportions=shape.proportions(x),
        names=tuple(markers.markers),
        moved=np.linalg.norm(places - problem.guess, axis=1),
        errors=errors,
        frames=len(used),
    )


def _observed(frame: Frame) -> Observation:
    ones = np.ones(len(frame.points))
    return Observation(frame.points, ones, 1e-4 * ones, landmarks=frame.landmarks)


def _poses(body: Body, pose: Pose, many: list[Observation]) -> list[Pose]:
    """Returns the poses of all frames, one after the other."""
    found = []
    for one in many:
        fit = LandmarkFit.of(body, one)
        pose = pose if fit is None else fit.fitted(pose, (4.0,))
        found.append(pose)
    return found


def _measured(seen: Observation, names: tuple[str, ...]) -> Array:
    """Returns the measured places of some markers, (M, 3) [m]; NaN where unmeasured."""
    marks = seen.landmarks
    rows = {} if marks is None else marks.rows
    nothing = np.full(3, np.nan)
    return np.array(
        [marks.positions[rows[name]] if marks and name in rows else nothing for name in names]
    )


def _errors(problem: MarkerProblem, x: Array, places: Array, poses: list[Pose]) -> Array:
    """Returns the root mean square error of each marker, (M,) [m]; NaN without a measurement."""
    squares = (problem.residuals(x, places, poses) ** 2).sum(axis=2)
    seen = np.isfinite(problem.measured).all(axis=2).sum(axis=0)
    return np.asarray(np.sqrt(squares.sum(axis=0) / np.where(seen, seen, np.nan)))
