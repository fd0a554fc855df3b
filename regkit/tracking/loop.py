"""The tracking loop from frame to frame."""

from __future__ import annotations

import time
from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np

from regkit.body import Body
from regkit.interfaces import (
    BoundTracker,
    Past,
    Preprocessor,
    Recording,
    Registrar,
    RegistrationResult,
    Tracker,
)
from regkit.observation import Frame, Observation
from regkit.skeleton import Pose
from regkit.system.compiled import loaded_loops
from regkit.system.errors import DataError, RegkitError

SUSPICIOUS = 10.0
"""Data spread over more than this multiple of a body's size are probably in another unit."""


@dataclass(frozen=True)
class TrackedFrame:
    """The result of one frame.

    Attributes:
        observation: The frame's data.
        registered: The registration result.
        seconds: Time to preprocess and register [s], without reading the file and compiling.
        preprocessing: Time to preprocess [s].
    """

    observation: Observation
    registered: RegistrationResult
    seconds: float
    preprocessing: float


def tracked(
    recording: Recording,
    preprocessor: Preprocessor,
    registrar: Registrar,
    tracker: Tracker,
    start: Pose,
) -> Iterator[TrackedFrame]:
    """Yields the frames of a recording, tracked one by one from a start pose.

    Args:
        recording: The recording.
        preprocessor: Preprocessor of the frames.
        registrar: Method bound to the body.
        tracker: Tracker that predicts the next pose.
        start: Pose of the body in the first frame.

    Raises:
        RegkitError: If a frame cannot be read or registered; the error names it.
    """
    past = Past.start(start)
    bound = tracker.bind(registrar)
    for index, frame in enumerate(recording.frames()):
        try:
            loops = loaded_loops()
            found = _step(frame, preprocessor, bound, past)
            if loaded_loops() != loops:
                # Loops were compiled or loaded meanwhile. Repeating the step gives the same result
                # and its true time.
                found = _step(frame, preprocessor, bound, past)
            _check_near(registrar.body, found.registered.pose, found.observation)
        except RegkitError as error:
            raise error.at(frame.place or f"{recording.name}: frame {index}") from None
        past = past.followed_by(found.registered)
        yield found


def _step(
    frame: Frame, preprocessor: Preprocessor, bound: BoundTracker, past: Past
) -> TrackedFrame:
    begun = time.perf_counter()
    observation = preprocessor.preprocess(frame)
    preprocessing = time.perf_counter() - begun
    registered = bound.step(observation, past)
    return TrackedFrame(observation, registered, time.perf_counter() - begun, preprocessing)


def _check_near(body: Body, pose: Pose, observation: Observation) -> None:
    """Checks that a body is near the data, as any further track would be meaningless.

    Raises:
        DataError: If the body is farther from all data than its size.
    """
    if not len(body.capsules):
        return
    sample = observation.points[:: max(1, len(observation.points) // 50)]
    placed = body.capsules.place(body.place(pose).transforms)
    distance = float(placed.surface_distance(sample).min())
    if distance > body.size:
        extent = float(np.linalg.norm(np.ptp(sample, axis=0)))
        hint = f"; the points are spread over {extent:.4g} m: are they in metres (depth_scale)?"
        raise DataError(
            f"the registered body is {distance:.3g} m away from the data; the start or the "
            "template's size is wrong, or the body was lost"
            + (hint if extent > SUSPICIOUS * body.size else "")
        )
