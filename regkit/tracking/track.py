"""Tracks: what was found in all frames of a recording."""

from __future__ import annotations

from dataclasses import dataclass, fields
from typing import Any

import numpy as np
from numpy.typing import NDArray

from regkit.body import Body
from regkit.skeleton import Pose
from regkit.system.arrays import Array


@dataclass(frozen=True)
class Track:
    """A tracked recording as arrays over its T frames.

    Attributes:
        root: T_camera_root, (T, 4, 4) [m].
        balls: (T, n_ball, 4) unit quaternions.
        hinges: (T, n_hinge) [rad].
        markers: (T, M, 3) [m], in the camera's frame.
        surface_distances: Median distance of a frame's points to the body's surface, (T,) [m].
        inlier_shares: Share of a frame's points that are inliers, (T,); NaN where unknown.
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
    inlier_shares: Array
    energies: Array
    evaluations: Array
    converged: Array
    seconds: Array
    preprocessing: Array

    def pose(self, index: int) -> Pose:
        """Returns the pose in a frame."""
        return Pose(self.root[index], self.balls[index], self.hinges[index])

    def __len__(self) -> int:
        """Number T of frames."""
        return len(self.seconds)

    def __getitem__(self, part: slice) -> Track:
        """Some of the frames."""
        return Track(**{field.name: getattr(self, field.name)[part] for field in fields(self)})

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
