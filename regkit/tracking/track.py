"""Tracks: what was found in all frames of a recording."""

from __future__ import annotations

from dataclasses import dataclass, fields
from typing import Any

import numpy as np
from numpy.typing import NDArray

from regkit.body import Body
from regkit.interfaces import Registrar
from regkit.skeleton import Placement, Pose
from regkit.system.arrays import Array
from regkit.tracking.loop import TrackedFrame


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
    """A tracked recording as arrays over its T frames.

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
        preprocessing: To observe, (T,) [s].
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
    preprocessing: Array

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
            preprocessing=np.array([frame.preprocessing for frame in frames]),
        )
