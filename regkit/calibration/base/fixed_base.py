"""The base of a robot that stands still, found from all frames of a recording together."""

from __future__ import annotations

import numpy as np

from regkit.body import Body
from regkit.body.verdict import Verdict
from regkit.calibration.base.found import FoundBase
from regkit.calibration.base.solution import solved
from regkit.config.model import Model
from regkit.config.plugin import slot_default, slot_defaults
from regkit.config.quantities import Count, FrameCount
from regkit.interfaces import (
    Method,
    Preprocessor,
    Recording,
    Registrar,
    Segmenter,
    Solver,
    StartSearch,
    Template,
    Tracker,
)
from regkit.observation import Observation
from regkit.skeleton import Pose
from regkit.system.errors import ConfigError, NotFoundError, RegkitError
from regkit.system.notes import note
from regkit.system.optional import one_blas_thread
from regkit.system.progress import steps, working
from regkit.tracking import Session, TrackRecorder

VOXEL = 0.0107
"""Voxel size as a fraction of the robot's size: 12 mm for an arm of 1.1 m."""

SIGMA = 0.4
"""Standard deviation of the points in voxels."""


class FixedBase(Model):
    """Settings of the estimation of a robot's base."""

    template: Template
    """Template of the robot with a free root."""
    preprocessor: Preprocessor | None = None
    """Preprocessor of the frames; by default voxels that suit the robot's size."""
    segmentation: tuple[Segmenter, ...] = slot_defaults(Segmenter)
    """Segmenters that take the robot out of the scene, applied in order."""
    start: StartSearch = slot_default(StartSearch)
    """Search for the pose in the first frame."""
    frames: Count = 30
    """Number of frames that are solved together, spread over the recording."""
    longest: FrameCount = 300
    """Maximum number of frames that are tracked, from the start."""
    method: Method = slot_default(Method, "surface")
    """Method that tracks the robot and whose energies are summed: the exact surface has the least
    bias. A template without a mesh takes the default method."""
    tracker: Tracker = slot_default(Tracker)
    """Tracker, unless the method has one of its own."""
    solver: Solver = slot_default(Solver, max_iterations=12, value_tolerance=1e-3)
    """Solver of the joint problem over all frames."""

    def found(self, recording: Recording) -> FoundBase:
        """Returns the base in a recording.

        Raises:
            ConfigError: If the template has no free root.
            NotFoundError: If the robot is surely found in no frame.
            RegkitError: If a frame cannot be read or registered.
        """
        with one_blas_thread():
            return self._found(recording)

    def _found(self, recording: Recording) -> FoundBase:
        session = Session(
            recording,
            self.template.plain(),
            self._preprocessor(),
            self.start,
            segmentation=self.segmentation,
        )
        size = float(np.median(self.template.candidate_sizes()))
        if not self.template.body(size).skeleton.free:
            raise ConfigError(
                f"the root of '{self.template.name()}' is fixed already; the base is sought with a "
                "template whose root has joint: {type: free}"
            )
        with working("searching the start"):
            start = session.begin()
        registrar = self._registrar(start.body)
        frames, poses = self._tracked(session, registrar, start.pose)
        return solved(registrar, frames, poses, self.solver)

    def _preprocessor(self) -> Preprocessor:
        """Returns the given preprocessor, or one for a robot of the median candidate size."""
        if self.preprocessor is not None:
            return self.preprocessor
        voxel = VOXEL * float(np.median(self.template.candidate_sizes()))
        data = Preprocessor.default(voxel=voxel, sigma=SIGMA * voxel)
        return Preprocessor.parse(data, place="calibration", field="preprocessor")

    def _registrar(self, body: Body) -> Registrar:
        """Returns the method bound to the robot, or the default one to a robot without a mesh."""
        try:
            return self.method.bind(body)
        except RegkitError as error:
            note(f"the base is found by the default method: {error.message}", place=body.name)
            choice = Method.default()
            return Method.parse(choice, place="calibration", field="method").bind(body)

    def _tracked(
        self, session: Session, registrar: Registrar, pose: Pose
    ) -> tuple[list[Observation], list[Pose]]:
        """Returns the data and poses of frames, spread over those in which the robot is found.

        Raises:
            NotFoundError: If it is surely found in none.
        """
        length = min(session.recording.length, self.longest)
        recorder = TrackRecorder(registrar, session.recording.fps)
        kept = []
        track = session.tracked(registrar, self.method.tracker or self.tracker, pose)
        for frame, _ in zip(steps(track, "tracking", length), range(length), strict=False):
            recorded = recorder.add(frame)
            if frame.observation is not None and recorded.verdict is Verdict.FOUND:
                kept.append((frame.observation, frame.registered.pose))
        if not kept:
            raise NotFoundError(
                "the robot is surely found in no frame; give its start, or see what the camera "
                "sees of it with regkit preview",
                place=session.recording.name,
            )
        chosen = np.linspace(0, len(kept) - 1, min(self.frames, len(kept))).round().astype(int)
        return [kept[at][0] for at in chosen], [kept[at][1] for at in chosen]
