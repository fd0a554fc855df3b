"""Calibration: a template with the proportions of the person or hand in a recording."""

from __future__ import annotations

from itertools import islice

import numpy as np

from regkit.calibration.frames import Looks, spread
from regkit.calibration.shared_shape import SOLVING
from regkit.calibration.subject import Subject
from regkit.calibration.subject_shape import SubjectShape
from regkit.config.model import Model
from regkit.config.plugin import slot_default, slot_defaults
from regkit.config.quantities import Count, FrameCount
from regkit.interfaces import (
    Method,
    Preprocessor,
    Recording,
    Segmenter,
    Solver,
    Start,
    StartSearch,
    Template,
    Tracker,
)
from regkit.system.errors import ConfigError
from regkit.system.optional import one_blas_thread
from regkit.system.progress import steps, working
from regkit.tracking import Session

ROUNDS = 2
"""Number of rounds of tracking and fitting: a body closer to the subject is tracked better."""

VOXEL, SMALLEST_VOXEL = 0.018, 0.01
"""Voxel size as a fraction of the body's size, and its lower bound [m]."""


class Calibration(Model):
    """Settings of the estimation of a subject's proportions."""

    template: Template
    """Template of the subject, with average proportions."""
    preprocessor: Preprocessor | None = None
    """Preprocessor of the frames; by default voxels that suit the body's size."""
    segmentation: tuple[Segmenter, ...] = slot_defaults(Segmenter)
    """Segmenters that take the body out of the scene, applied in order before the preprocessor."""
    start: StartSearch = slot_default(StartSearch)
    """Search for pose and size in the first frame, or the pose itself, which requires the size."""
    frames: Count = 12
    """Number of frames used for the fit, spread over the tracked part of the recording."""
    longest: FrameCount = 300
    """Maximum number of tracked frames, from the start of the recording."""
    method: Method = slot_default(Method)
    """Method that registers the body to each frame of the recording."""
    tracker: Tracker = slot_default(Tracker)
    """Tracker that predicts the next frame's pose, unless the method defines one."""
    solver: Solver = slot_default(Solver, **SOLVING)
    """Solver of the joint problem over all frames."""

    def subject(self, recording: Recording) -> Subject:
        """Returns the subject of a recording.

        Raises:
            RegkitError: If the template has no capsules, tracking fails, or the fitted body is
                implausible.
        """
        with one_blas_thread():
            return self._subject(recording)

    def _subject(self, recording: Recording) -> Subject:
        template = self.template.plain()
        shape = SubjectShape.of(template.description())
        # The fit finds the size; the start needs only a rough one.
        session = Session(
            recording,
            template,
            self._preprocessor(),
            self.start,
            sized_in=1,
            segmentation=self.segmentation,
        )
        with working("searching the start"):
            start = session.begin()
        if not len(start.body.capsules):
            raise ConfigError(
                f"the template '{start.body.name}' has no capsules, which calibration needs to "
                "find its proportions"
            )
        x = shape.origin(start.body.size)
        for _ in range(ROUNDS):
            looks = self._looks(session, start)
            with working("fitting"):
                x, looks = shape.fitted(x, looks, self.solver)
            start = Start(shape.body(x), looks.first)
        return Subject.found(shape, x, looks, recording.name)

    def _preprocessor(self) -> Preprocessor:
        """Returns the given preprocessor, or one for a body of the median candidate size."""
        if self.preprocessor is not None:
            return self.preprocessor
        size = float(np.median(self.template.candidate_sizes()))
        voxel = max(VOXEL * size, SMALLEST_VOXEL)
        data = Preprocessor.default(voxel=voxel, sigma=max(voxel / 3.0, SMALLEST_VOXEL / 2.0))
        return Preprocessor.parse(data, place="calibration", field="preprocessor")

    def _looks(self, session: Session, start: Start) -> Looks:
        """Tracks the body and returns the frames chosen for the fit."""
        length = min(session.recording.length, self.longest)
        registrar = self.method.bind(start.body)
        track = session.tracked(registrar, self.method.tracker or self.tracker, start.pose)
        return spread(steps(islice(track, length), "tracking", length), length, self.frames)
