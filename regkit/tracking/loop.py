"""The tracking loop from frame to frame."""

from __future__ import annotations

import time
from collections.abc import Iterator
from dataclasses import dataclass
from math import isnan

from regkit.interfaces import (
    BoundSegmenter,
    Expected,
    Past,
    Preprocessor,
    Recording,
    Registrar,
    RegistrationResult,
    Tracker,
)
from regkit.observation import Frame, Observation
from regkit.skeleton import Pose
from regkit.system.compilations import loaded_loops
from regkit.system.errors import NoDataError, RegkitError
from regkit.tracking.clocks import ClockWatch
from regkit.tracking.landmarks import tell_unread
from regkit.tracking.segmented import segmented

LONG = 1.0
"""After a gap of this time [s] a body may be anywhere, as after frames without data.

Shorter gaps are not treated so: a search for the body takes a part of a second itself, in which a
camera's frames are dropped.
"""


@dataclass(frozen=True)
class TrackedFrame:
    """The result of one frame.

    Attributes:
        observation: The frame's data; None if it has none.
        registered: The registration result; without data, the last pose.
        seconds: Time to segment, preprocess and register [s], without reading the file and
            compiling.
        preprocessing: Time to segment and preprocess [s].
    """

    observation: Observation | None
    registered: RegistrationResult
    seconds: float
    preprocessing: float


class Follower:
    """Tracks a body from frame to frame, with the past that the next frame needs.

    Args:
        segmenter: Segmenter bound to the recording.
        preprocessor: Preprocessor of the frames.
        registrar: Method bound to the body.
        tracker: Tracker that predicts the next pose.
        start: Pose of the body in the first frame.
        clocks: Watches the clocks of several cameras.
    """

    def __init__(
        self,
        segmenter: BoundSegmenter,
        preprocessor: Preprocessor,
        registrar: Registrar,
        tracker: Tracker,
        start: Pose,
        clocks: ClockWatch | None = None,
    ) -> None:
        self._segmenter = segmenter
        self._preprocessor = preprocessor
        self._registrar = registrar
        self._tracker = tracker.bind(registrar)
        self._past = Past.start(start)
        self._clocks = clocks

    def follow(self, frame: Frame) -> TrackedFrame:
        """Returns the next frame, tracked; one without data keeps the last pose.

        Raises:
            RegkitError: If the frame cannot be registered; the past remains as it was.
        """
        loops = loaded_loops()
        found = self._step(frame)
        if loaded_loops() != loops:
            # Loops were compiled or loaded meanwhile. Repeating the step gives the same result and
            # its true time.
            found = self._step(frame)
        if found.observation is None:
            self._interrupt()
        else:
            if not self._past.frames and not self._registrar.reads_landmarks:
                tell_unread(found.observation.landmarks)
            self._past = self._past.followed_by(found.registered)
            if self._clocks is not None:
                self._clocks.add(found.observation, found.registered.pose)
        return found

    def skip(self, reason: str) -> TrackedFrame:
        """Returns a frame that cannot be read, which keeps the last pose.

        Args:
            reason: Why it cannot be read.
        """
        self._interrupt()
        return TrackedFrame(None, self._past.last.without_data(reason), 0.0, 0.0)

    def pause(self, seconds: float) -> None:
        """Tells that the motion since the last frame is unknown, as after a gap in time.

        Args:
            seconds: Duration of the gap [s].
        """
        if seconds >= LONG:
            self._interrupt()
        else:
            self._past = self._past.paused()

    def _interrupt(self) -> None:
        self._past = self._past.interrupted()
        if self._clocks is not None:
            self._clocks.pause()

    def _step(self, frame: Frame) -> TrackedFrame:
        begun = time.perf_counter()
        try:
            expected = Expected.of(self._registrar.body, self._past)
            left = segmented(self._segmenter, frame, expected)
            observation = self._preprocessor.observation(left)
            if self._clocks is not None:
                observation = self._clocks.trusted(observation)
        except NoDataError as error:
            seconds = time.perf_counter() - begun
            return TrackedFrame(None, self._past.last.without_data(error.message), seconds, seconds)
        preprocessing = time.perf_counter() - begun
        registered = self._tracker.step(observation, self._past)
        if isnan(registered.effective_points):
            registered = self._past.counted(self._registrar, observation, registered)
        return TrackedFrame(observation, registered, time.perf_counter() - begun, preprocessing)


def tracked(recording: Recording, follower: Follower) -> Iterator[TrackedFrame]:
    """Yields the frames of a recording, tracked one by one.

    Raises:
        RegkitError: If a frame cannot be read or registered; the error names it.
    """
    for index, frame in enumerate(recording.frames()):
        try:
            found = follower.follow(frame)
        except RegkitError as error:
            raise error.at(frame.place or f"{recording.name}: frame {index}") from None
        yield found
