"""The tracking loop from frame to frame."""

from __future__ import annotations

import time
from collections.abc import Iterator
from dataclasses import dataclass

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
from regkit.tracking.segmented import segmented


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


def tracked(
    recording: Recording,
    segmenter: BoundSegmenter,
    preprocessor: Preprocessor,
    registrar: Registrar,
    tracker: Tracker,
    start: Pose,
) -> Iterator[TrackedFrame]:
    """Yields the frames of a recording, tracked one by one from a start pose.

    A frame without data keeps the last pose, and tracking goes on from it.

    Args:
        recording: The recording.
        segmenter: Segmenter bound to the recording.
        preprocessor: Preprocessor of the frames.
        registrar: Method bound to the body.
        tracker: Tracker that predicts the next pose.
        start: Pose of the body in the first frame.

    Raises:
        RegkitError: If a frame cannot be read or registered; the error names it.
    """
    past = Past.start(start)
    bound = tracker.bind(registrar)

    def step(frame: Frame) -> TrackedFrame:
        begun = time.perf_counter()
        try:
            left = segmented(segmenter, frame, Expected.of(registrar.body, past))
            observation = preprocessor.preprocess(left)
        except NoDataError as error:
            seconds = time.perf_counter() - begun
            return TrackedFrame(None, past.last.without_data(error.message), seconds, seconds)
        preprocessing = time.perf_counter() - begun
        registered = bound.step(observation, past)
        return TrackedFrame(observation, registered, time.perf_counter() - begun, preprocessing)

    for index, frame in enumerate(recording.frames()):
        try:
            loops = loaded_loops()
            found = step(frame)
            if loaded_loops() != loops:
                # Loops were compiled or loaded meanwhile. Repeating the step gives the same result
                # and its true time.
                found = step(frame)
        except RegkitError as error:
            raise error.at(frame.place or f"{recording.name}: frame {index}") from None
        if found.observation is None:
            past = past.interrupted()
        else:
            past = past.followed_by(found.registered)
        yield found
