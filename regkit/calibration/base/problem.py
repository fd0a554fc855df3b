"""The joint problem: one pose of a robot's base for all frames, and the joints of each frame."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from regkit.interfaces import Problem, Registrar
from regkit.observation import Observation
from regkit.registration import TangentCoordinates
from regkit.skeleton import Pose
from regkit.system.arrays import Array, Indices

BASE = 6
"""Degrees of freedom of the base."""


class BaseProblem(Problem):
    """The energies of several frames as a function of one base and of the joints of each frame.

    With the energy E_f of a frame, a mean over its points, and their effective number N_f, the
    energy is the sum of N_f E_f, so that its curvature is the information of the whole. Every
    energy is bound at the pose at which it is evaluated.

    Args:
        registrar: The method bound to a body with a free root.
        frames: The data of F frames.
        poses: Initial poses in these frames; that of the root is ``base``.
        base: Initial T_world_base, (4, 4) [m].
        points: Effective number of points of each frame, (F,).
    """

    def __init__(
        self,
        registrar: Registrar,
        frames: Sequence[Observation],
        poses: Sequence[Pose],
        base: Array,
        points: Array,
    ) -> None:
        self._registrar, self._frames, self._points = registrar, frames, points
        skeleton = registrar.body.skeleton
        self._charts = [
            TangentCoordinates(skeleton, Pose(base, pose.balls, pose.hinges)) for pose in poses
        ]
        self._joints = len(self._charts[0].origin()) - BASE
        bounds = [chart.bounds() for chart in self._charts]
        lower, upper = (
            np.concatenate([side[0][:BASE], *(one[BASE:] for one in side)])
            for side in zip(*bounds, strict=True)
        )
        self.start = np.zeros(BASE + len(poses) * self._joints)
        self.lower, self.upper = lower, upper

    def base(self, x: Array) -> Array:
        """Returns T_world_base (4, 4) [m] at coordinates x (m,)."""
        return self.poses(x)[0].root

    def poses(self, x: Array) -> list[Pose]:
        """Returns the poses of all frames at coordinates x (m,)."""
        return [
            chart.pose(x[own]) for chart, own in zip(self._charts, self._indices(), strict=True)
        ]

    def value_and_gradient(self, x: Array) -> tuple[float, Array]:
        """Returns the energy at coordinates x (m,) and its gradient (m,)."""
        return self.normal_equations(x)[:2]

    def normal_equations(self, x: Array) -> tuple[float, Array, Array]:
        """Returns the energy, its gradient (m,) and the Gauss-Newton matrix (m, m)."""
        total, gradient, matrix = 0.0, np.zeros(len(x)), np.zeros((len(x), len(x)))
        for frame, count, chart, own in zip(
            self._frames, self._points, self._charts, self._indices(), strict=True
        ):
            value, force, square = self._registrar.normal_equations(frame, chart.pose(x[own]))
            jacobian = chart.jacobian(x[own])
            total += count * value
            gradient[own] += count * (jacobian.T @ force)
            matrix[np.ix_(own, own)] += count * (jacobian.T @ square @ jacobian)
        return total, gradient, matrix

    def projected(self, x: Array) -> Array:
        """Returns coordinates (m,) with all joints within their limits."""
        x = np.clip(x, self.lower, self.upper)
        for chart, own in zip(self._charts, self._indices(), strict=True):
            pose = chart.pose(x[own])
            within = chart.skeleton.limits.projected(pose)
            if within is not pose:
                x[own[BASE:]] = chart.vector(within)[BASE:]
        return x

    def covariance(self, x: Array) -> Array:
        """Returns the covariance (6, 6) of the base at coordinates x (m,).

        It is that of a step of ``Skeleton.retract``: a translation [m] in the world, then a
        rotation vector [rad] in the base's frame. The joints of all frames are eliminated, with
        what their limits alone tell of them.

        The frames count as one: base and camera stand still, so that what the model lacks, and what
        a surface hides, is the same in all of them.
        """
        moved = TangentCoordinates(self._registrar.body.skeleton, self.poses(x)[0])
        spread = self._registrar.body.skeleton.spread_information
        own = self._registrar.body.skeleton.independent_dofs[BASE:]
        information = np.zeros((BASE, BASE))
        for frame, count, pose in zip(self._frames, self._points, self.poses(x), strict=True):
            _, _, square = self._registrar.normal_equations(frame, pose)
            jacobian = TangentCoordinates(moved.skeleton, pose).jacobian(moved.origin())
            square = count * (jacobian.T @ square @ jacobian)
            joints = square[BASE:, BASE:] + spread[np.ix_(own, own)]
            cross = square[BASE:, :BASE]
            information += square[:BASE, :BASE] - cross.T @ np.linalg.solve(joints, cross)
        information = information / len(self._frames) + spread[:BASE, :BASE]
        return np.asarray(np.linalg.inv(0.5 * (information + information.T)))

    def _indices(self) -> list[Indices]:
        """Returns the indices of each frame's coordinates: the base's, then its joints'."""
        return [
            np.concatenate([np.arange(BASE), BASE + frame * self._joints + np.arange(self._joints)])
            for frame in range(len(self._charts))
        ]
