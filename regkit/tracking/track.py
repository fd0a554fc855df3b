"""Tracks: the results of all frames of a recording."""

from __future__ import annotations

from dataclasses import dataclass, fields
from functools import cached_property
from typing import Any

import numpy as np
from numpy.typing import NDArray

from regkit.body import Body
from regkit.body.support import WEAK
from regkit.body.verdict import Verdict, frame_verdicts
from regkit.skeleton import Pose
from regkit.system.arrays import Array
from regkit.system.brief import Brief


@dataclass(frozen=True)
class Track(Brief):
    """A tracked recording as arrays over its T frames.

    Attributes:
        numbers: Numbers of the frames in the recording, (T,); a camera's dropped frames are
            missing.
        times: Times of the frames [s], (T,), on the recording's clock.
        root: T_camera_root, (T, 4, 4) [m].
        balls: Unit quaternions of the ball joints, (T, n_ball, 4).
        hinges: Hinge angles, (T, n_hinge) [rad].
        markers: Markers in the camera's frame, (T, M, 3) [m].
        surface_distances: Median distance of a frame's points to the body's surface, (T,) [m].
        inlier_shares: Fraction of a frame's points that lie on the body's surface, (T,); NaN
            without data. Unlike a method's own inlier probability, it compares methods.
        coverages: Fraction of the visible body that has data nearby, (T,); NaN without data.
        misfits: Mean distance of the points to the body and of the visible body to the points, in
            radii of a typical limb, (T,); NaN without data.
        reliefs: Deviation of the points along their thinnest direction, in radii of a typical limb,
            (T,); NaN without data. Data without relief are a wall.
        supports: Fraction of each segment's axis that has data of its own, (T, S), from 0 to 1; 0
            without data, NaN for a segment without a surface. A pose with little support is a
            guess.
        points: Number of points, (T,); 0 for a frame without data, whose pose is the last one.
        energies: Energies in the method's own units, (T,).
        evaluations: Numbers of energy evaluations, (T,).
        converged: Whether the solver met a tolerance, (T,).
        seconds: Time to preprocess and register, (T,) [s].
        preprocessing: Time to preprocess, (T,) [s].
    """

    numbers: Array
    times: Array
    root: Array
    balls: Array
    hinges: Array
    markers: Array
    surface_distances: Array
    inlier_shares: Array
    coverages: Array
    misfits: Array
    reliefs: Array
    supports: Array
    points: Array
    energies: Array
    evaluations: Array
    converged: Array
    seconds: Array
    preprocessing: Array

    @staticmethod
    def layout(body: Body) -> dict[str, tuple[int, ...]]:
        """Returns the shapes of a frame's values, for the track of a body."""
        rest = body.skeleton.rest()
        shapes: dict[str, tuple[int, ...]] = {
            "root": rest.root.shape,
            "balls": rest.balls.shape,
            "hinges": rest.hinges.shape,
            "markers": (len(body.markers.names), 3),
            "supports": (len(body.skeleton.names),),
        }
        return {field.name: shapes.get(field.name, ()) for field in fields(Track)}

    def pose(self, index: int) -> Pose:
        """Returns the pose of a frame."""
        return Pose(self.root[index], self.balls[index], self.hinges[index])

    @cached_property
    def verdicts(self) -> tuple[Verdict, ...]:
        """Whether the body was found in each frame, (T,)."""
        shares = (self.inlier_shares, self.coverages, self.misfits, self.reliefs)
        return frame_verdicts(self.points, *shares)

    @property
    def seen(self) -> NDArray[np.bool_]:
        """Whether each frame has data, (T,)."""
        return self.points > 0

    @property
    def weakly_seen(self) -> Array:
        """Fraction of the frames with data in which each segment has little of it, (S,)."""
        known = self.supports[self.seen]
        return np.asarray((known < WEAK).sum(axis=0) / max(len(known), 1))

    def __len__(self) -> int:
        """Number T of frames."""
        return len(self.seconds)

    def __getitem__(self, part: slice) -> Track:
        """Returns a range of the frames."""
        return Track(**{field.name: getattr(self, field.name)[part] for field in fields(self)})

    def named_arrays(self, body: Body) -> dict[str, NDArray[Any]]:
        """Returns these arrays, verdicts, names of markers and joints, and the size, for a file."""
        return {field.name: getattr(self, field.name) for field in fields(self)} | {
            "verdicts": np.array(self.verdicts, dtype=np.str_),
            "marker_names": np.array(body.markers.names, dtype=np.str_),
            "ball_names": np.array(body.skeleton.ball_names, dtype=np.str_),
            "hinge_names": np.array(body.skeleton.hinge_names, dtype=np.str_),
            "size": np.array(body.size),
        }
