"""Following a body through a sequence: the loop that every experiment runs."""

from __future__ import annotations

import time
from collections.abc import Iterator
from dataclasses import dataclass, fields
from typing import Any

import numpy as np
from numpy.typing import NDArray

from regkit.arrays import Array
from regkit.body import Body
from regkit.errors import DataError, RegkitError
from regkit.interfaces import Observer, Registered, Registrar, Sequence, Tracker
from regkit.observation import Observation
from regkit.skeleton import Placement, Pose

SUSPICIOUS = 10.0
"""Data spread over so many times a body's size are more likely to be in another unit."""


@dataclass(frozen=True)
class TrackedFrame:
    """What was found in one frame.

    Attributes:
        observation: What was measured, as data.
        registered: The pose and how it was found.
        seconds: Time to observe and register; reading the file is not counted.
        observing: How much of it was to observe [s].
    """

    observation: Observation
    registered: Registered
    seconds: float
    observing: float


def tracked(
    sequence: Sequence, observer: Observer, registrar: Registrar, tracker: Tracker, start: Pose
) -> Iterator[TrackedFrame]:
    """Track a sequence from a start pose, frame by frame.

    Raises:
        RegkitError: If a frame cannot be read or registered; it says which.
    """
    past = [Registered.given(start)]
    follower = tracker.follow(registrar)
    for index, frame in enumerate(sequence.frames()):
        begun = time.perf_counter()
        try:
            observation = observer.observe(frame)
            observing = time.perf_counter() - begun
            registered = follower.step(observation, past)
            seconds = time.perf_counter() - begun
            _check_near(registrar.body, registered.pose, observation)
        except RegkitError as error:
            raise error.at(frame.place or f"{sequence.name}: frame {index}") from None
        past.append(registered)
        yield TrackedFrame(observation, registered, seconds, observing)


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


def _surface_distance(body: Body, placement: Placement, points: Array) -> float:
    """Median distance [m] of points to the body's capsules, or to the points of its surface."""
    if len(body.capsules):
        placed = body.capsules.place(placement.transforms)
        return float(np.median(np.abs(placed.surface_distance(points))))
    if body.surface is None:
        return float("nan")
    from scipy.spatial import KDTree

    distances, _ = KDTree(body.surface.place(placement.transforms)).query(points)
    return float(np.median(distances))


@dataclass(frozen=True)
class Track:
    """A tracked sequence as arrays over its T frames.

    Attributes:
        root: T_camera_root, (T, 4, 4) [m].
        balls: (T, n_ball, 4) unit quaternions.
        hinges: (T, n_hinge) [rad].
        markers: (T, M, 3) [m], in the camera's frame.
        surface_distances: Median distance of a frame's points to the body's surface, (T,) [m].
        energies: (T,) in the method's own units.
        evaluations: (T,).
        converged: Whether the solver met a tolerance, (T,).
        seconds: To observe and register, (T,).
        observing: To observe, (T,) [s].
    """

    root: Array
    balls: Array
    hinges: Array
    markers: Array
    surface_distances: Array
    energies: Array
    evaluations: Array
    converged: Array
    seconds: Array
    observing: Array

    def pose(self, index: int) -> Pose:
        """The pose in a frame."""
        return Pose(self.root[index], self.balls[index], self.hinges[index])

    def named_arrays(self, body: Body) -> dict[str, NDArray[Any]]:
        """What a file holds: these arrays, the names of markers and ball joints, and the size."""
        skeleton = body.skeleton
        links = list(skeleton.segment_links)
        balls = [skeleton.names[links.index(link)] for link in skeleton.ball_links]
        return {field.name: getattr(self, field.name) for field in fields(self)} | {
            "marker_names": np.array(body.markers.names, dtype=np.str_),
            "ball_names": np.array(balls, dtype=np.str_),
            "size": np.array(body.size),
        }

    @classmethod
    def of(cls, frames: list[TrackedFrame], registrar: Registrar) -> Track:
        """The arrays of tracked frames; the surface is that of the registrar's body."""
        body = registrar.body
        poses = [frame.registered.pose for frame in frames]
        placements = [body.place(pose) for pose in poses]
        distances = [
            _surface_distance(body, placement, frame.observation.points)
            for placement, frame in zip(placements, frames, strict=True)
        ]
        return cls(
            root=np.array([pose.root for pose in poses]),
            balls=np.array([pose.balls for pose in poses]),
            hinges=np.array([pose.hinges for pose in poses]),
            markers=np.array([body.markers.place(p.transforms) for p in placements]),
            surface_distances=np.array(distances),
            energies=np.array([frame.registered.energy for frame in frames]),
            evaluations=np.array([float(frame.registered.evaluations) for frame in frames]),
            converged=np.array([float(frame.registered.converged) for frame in frames]),
            seconds=np.array([frame.seconds for frame in frames]),
            observing=np.array([frame.observing for frame in frames]),
        )
