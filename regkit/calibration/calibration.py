"""Calibration: a template that has the proportions of the person or hand in a recording."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace
from itertools import islice
from typing import Annotated, Protocol

import numpy as np
from pydantic import Field

from regkit.calibration.frames import Looks, spread
from regkit.calibration.problem import SubjectProblem
from regkit.calibration.shape import Shape
from regkit.calibration.subject import Subject
from regkit.config.model import Model
from regkit.config.plugin import slot_default
from regkit.interfaces import Method, Preprocessor, Recording, Solver, Template, Tracker
from regkit.skeleton import PoseDescription
from regkit.start import Start
from regkit.system.arrays import Array
from regkit.system.errors import ConfigError
from regkit.system.optional import one_blas_thread
from regkit.tracking import Session, TrackedFrame

ROUNDS = 2
"""How often the body is tracked and its proportions are found: a body that is nearer to the subject
is tracked better."""

VOXEL, SMALLEST_VOXEL = 0.018, 0.01
"""Side of the cubes whose points are averaged, as a part of the body's size, and at least [m]."""


class Watcher(Protocol):
    """Who wants to know how far a calibration is."""

    def begin(self, task: str, steps: int) -> None:
        """Something begins that takes so many steps."""

    def advance(self) -> None:
        """One more step is done."""


class Calibration(Model):
    """How a subject's proportions are found."""

    template: Template
    """What is seen, of usual proportions."""
    preprocessor: Preprocessor | None = None
    """How frames become data; points averaged in cubes that suit the body's size without it."""
    start: PoseDescription | None = None
    """Pose in the first frame; found from the cloud without it. It needs the template's size."""
    frames: Annotated[int, Field(ge=1)] = 12
    """In how many frames the body is looked at, spread over those that are tracked."""
    longest: Annotated[int, Field(ge=1)] = 300
    """How many frames are tracked at most, from the start of the recording."""
    method: Method = slot_default(Method)
    """What registers the body to each frame of the recording."""
    tracker: Tracker = slot_default(Tracker)
    """How one frame's pose leads to the next, if the method does not say."""
    solver: Solver = slot_default(Solver, max_iterations=30, value_tolerance=1e-4)
    """What makes the gaps of all frames small."""

    def subject(self, recording: Recording, watcher: Watcher) -> Subject:
        """Returns the subject of a recording.

        Raises:
            RegkitError: If the template has no capsules, the recording cannot be tracked, or the
                body that comes out is none.
        """
        with one_blas_thread():
            return self._subject(recording, watcher)

    def _subject(self, recording: Recording, watcher: Watcher) -> Subject:
        shape = Shape(self.template.description())
        # The fit finds the size; a start needs only a rough one.
        session = Session(recording, self.template, self._preprocessor(), self.start, sized_in=1)
        start = session.begin()
        if not len(start.body.capsules):
            raise ConfigError(
                f"the template '{start.body.name}' has no capsules, without which its proportions "
                "cannot be found"
            )
        x = shape.origin(start.body.size)
        for _ in range(ROUNDS):
            looks = self._looks(session, start, watcher)
            x, looks = self._fitted(shape, x, looks, watcher)
            start = Start(shape.body(x), looks.first)
        return Subject.found(shape, x, looks, recording.name)

    def _preprocessor(self) -> Preprocessor:
        """Returns the given preprocessor, or one for a body of the usual size."""
        if self.preprocessor is not None:
            return self.preprocessor
        size = float(np.median(self.template.candidate_sizes()))
        voxel = max(VOXEL * size, SMALLEST_VOXEL)
        data = Preprocessor.default(voxel=voxel, sigma=max(voxel / 3.0, SMALLEST_VOXEL / 2.0))
        return Preprocessor.parse(data, place="calibration", field="preprocessor")

    def _looks(self, session: Session, start: Start, watcher: Watcher) -> Looks:
        """Returns the body tracked, and the frames chosen in which it is looked at."""
        length = min(session.recording.length, self.longest)
        watcher.begin("tracking", length)
        registrar = self.method.bind(start.body)
        track = session.tracked(registrar, self.method.tracker or self.tracker, start.pose)
        return spread(_watched(islice(track, length), watcher), length, self.frames)

    def _fitted(
        self, shape: Shape, x: Array, looks: Looks, watcher: Watcher
    ) -> tuple[Array, Looks]:
        """Returns the proportions (1 + 2 G) and poses of least gaps."""
        watcher.begin("fitting", 1)
        problem = SubjectProblem(shape, x, looks.clouds, looks.poses)
        solution = self.solver.minimize(problem)
        watcher.advance()
        return problem.shape(solution.x), replace(looks, poses=problem.poses(solution.x))


def _watched(track: Iterator[TrackedFrame], watcher: Watcher) -> Iterator[TrackedFrame]:
    for frame in track:
        watcher.advance()
        yield frame
