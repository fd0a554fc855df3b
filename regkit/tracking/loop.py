"""Following a body through a recording: the loop that every experiment runs."""

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
"""Data spread over so many times a body's size are more likely to be in another unit."""


@dataclass(frozen=True)
class TrackedFrame:
    """What was found in one frame.

    Attributes:
        observation: What was measured, as data.
        registered: The pose and how it was found.
        seconds: Time to observe and register; reading the file is not counted, nor is compiling.
        preprocessing: How much of it was to observe [s].
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
    """Track a recording from a start pose, frame by frame.

    Raises:
        RegkitError: If a frame cannot be read or registered; it says which.
    """
    past = Past.start(start)
    bound = tracker.bind(registrar)
    for index, frame in enumerate(recording.frames()):
        try:
            loops = loaded_loops()
            found = _step(frame, preprocessor, bound, past)
            if loaded_loops() != loops:
                # Loops were compiled or loaded meanwhile. The step gives the same result again,
                # and takes its own time.
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
    """Refuse a body far from the data: what follows could only look like a track.

    Raises:
        DataError: If it is farther from all data than it is large.
    """
    if not len(body.capsules):
        return
    some = observation.points[:: max(1, len(observation.points) // 50)]
    placed = body.capsules.place(body.place(pose).transforms)
    distance = float(placed.surface_distance(some).min())
    if distance > body.size:
        extent = float(np.linalg.norm(np.ptp(some, axis=0)))
        hint = f"; the points are spread over {extent:.4g} m: are they in metres (depth_scale)?"
        raise DataError(
            f"the registered body is {distance:.3g} m away from the data; the start or the "
            "template's size is wrong, or the body was lost"
            + (hint if extent > SUSPICIOUS * body.size else "")
        )
