"""Tracks: the results of all frames of a recording."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, fields
from functools import cached_property
from typing import Any

import numpy as np
from numpy.typing import NDArray

from regkit.body import Body
from regkit.body.support import WEAK
from regkit.body.verdict import Verdict
from regkit.skeleton import Pose
from regkit.system.arrays import Array
from regkit.system.brief import Brief
from regkit.tracking.frame_verdicts import body_verdicts, verdicts_of

UNCERTAINTY = ("effective_points", "covariances", "information", "pulls")
"""Arrays that a track has only if its method knows how sure it is."""

EVIDENCE = ("information", "pulls")
"""Those of them that only smoothing needs."""


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
        effective_points: Effective numbers of independent points, (T,); NaN if unknown.
        covariances: Covariances of the degrees of freedom, on the tangent space at the poses,
            (T, n, n) in [m] and [rad]; NaN for a frame without data, None if the method has none.
        information: What each frame's data alone tell of the independent degrees of freedom,
            (T, m, m), as ``Curvature.information``; NaN without data, None if it is not kept.
        pulls: How each frame's data alone pull at its pose, (T, m), as ``Curvature.pull``; None if
            it is not kept.
        body_shares: Inlier share, coverage, misfit and relief of each of K bodies that move freely
            beside each other, of its own points, (T, K, 4); NaN where it is hidden. None of one
            body.
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
    effective_points: Array | None = None
    covariances: Array | None = None
    information: Array | None = None
    pulls: Array | None = None
    body_shares: Array | None = None

    @staticmethod
    def layout(body: Body, *, information: bool = True) -> dict[str, tuple[int, ...]]:
        """Returns the shapes of a frame's values, for the track of a body.

        Args:
            body: The body.
            information: Whether to keep what the data alone tell, by which a track is smoothed.
        """
        rest = body.skeleton.rest()
        dofs, own = body.skeleton.dofs, len(body.skeleton.independent_dofs)
        shapes: dict[str, tuple[int, ...]] = {
            "root": rest.root.shape,
            "balls": rest.balls.shape,
            "hinges": rest.hinges.shape,
            "markers": (len(body.markers.names), 3),
            "supports": (len(body.skeleton.names),),
            "covariances": (dofs, dofs),
            "information": (own, own),
            "pulls": (own,),
            "body_shares": (len(body.free_bodies), 4),
        }
        names = [field.name for field in fields(Track)]
        if not body.free_bodies:
            names.remove("body_shares")
        kept = [name for name in names if information or name not in EVIDENCE]
        return {name: shapes.get(name, ()) for name in kept}

    @classmethod
    def of(cls, arrays: Mapping[str, Array]) -> Track:
        """Returns the track of the rows of its frames, without what is unknown in all of them."""
        known = dict(arrays)
        for name in UNCERTAINTY:
            if name in known and not np.isfinite(known[name]).any():
                del known[name]
        return cls(**known)

    def marker_covariances(self, body: Body) -> Array | None:
        """Returns the covariances of the markers, (T, M, 3, 3) [m^2], in the camera's frame.

        NaN for a frame without data; None if they are unknown.
        """
        if self.covariances is None:
            return None
        jacobians = np.array([
            body.markers.jacobian(body.place(self.pose(index))) for index in range(len(self))
        ])  # fmt: skip
        turned = jacobians.transpose(0, 1, 3, 2)
        return np.asarray(jacobians @ self.covariances[:, None] @ turned)

    def marker_deviations(self, body: Body) -> Array | None:
        """Returns the standard deviations of the markers along the camera's axes, (T, M, 3) [m]."""
        covariances = self.marker_covariances(body)
        if covariances is None:
            return None
        return np.asarray(np.sqrt(np.maximum(np.einsum("tmii->tmi", covariances), 0.0)))

    def pose(self, index: int) -> Pose:
        """Returns the pose of a frame."""
        return Pose(self.root[index], self.balls[index], self.hinges[index])

    @cached_property
    def verdicts(self) -> tuple[Verdict, ...]:
        """Whether the body was found in each frame, (T,); of several bodies, each of them."""
        return verdicts_of(self._arrays())

    @cached_property
    def body_verdicts(self) -> tuple[tuple[Verdict, ...], ...]:
        """Whether each of several bodies was found in each frame, T times K; hidden: no data."""
        shares = self.body_shares
        return body_verdicts(self.points, np.zeros((len(self), 0, 4)) if shares is None else shares)

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
        return Track(**{name: array[part] for name, array in self._arrays().items()})

    def _arrays(self) -> dict[str, Array]:
        """Returns the known arrays by name."""
        arrays = {field.name: getattr(self, field.name) for field in fields(self)}
        return {name: array for name, array in arrays.items() if array is not None}

    def named_arrays(self, body: Body) -> dict[str, NDArray[Any]]:
        """Returns these arrays, verdicts, names of markers and joints, and the size, for a file."""
        arrays = self._arrays()
        # It is only needed to smooth the track, and as large as all others together.
        kept = {name: array for name, array in arrays.items() if name not in EVIDENCE}
        if body.free_bodies:
            kept["body_names"] = np.array([one.name for one in body.free_bodies], dtype=np.str_)
        return kept | {
            "verdicts": np.array(self.verdicts, dtype=np.str_),
            "marker_names": np.array(body.markers.names, dtype=np.str_),
            "ball_names": np.array(body.skeleton.ball_names, dtype=np.str_),
            "hinge_names": np.array(body.skeleton.hinge_names, dtype=np.str_),
            "size": np.array(body.size),
        }
