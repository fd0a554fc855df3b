"""The joint problem of one shape and the poses in several frames."""

from __future__ import annotations

from abc import abstractmethod
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass
from types import MappingProxyType
from typing import Any

import numpy as np

from regkit.interfaces import Problem
from regkit.registration import TangentCoordinates
from regkit.skeleton import Pose, Skeleton
from regkit.system.arrays import Array, Indices

STIFFNESS = 0.05
"""Weight of a joint's rotation [rad] against a distance [cutoff]; a joint without data stays."""

SOLVING: Mapping[str, Any] = MappingProxyType(
    {"max_iterations": 60, "value_tolerance": 1e-6, "resting": 1e-7}
)
"""Settings of the default solver; a solver that rests more holds what few distances show."""


@dataclass(frozen=True)
class FrameEnergy:
    """The energy of R distances in a frame, with what makes its derivatives.

    Attributes:
        value: The energy.
        rows: Derivatives of the distances to the shape and to the pose's degrees of freedom,
            (R, P + n).
        slopes: Derivative of the energy to each distance, (R,).
        curvatures: Weight of each distance in the Gauss-Newton matrix, (R,).
    """

    value: float
    rows: Array
    slopes: Array
    curvatures: Array


class SharedShapeProblem(Problem):
    """One shape and the poses in F frames, with priors on the shape and on joint rotations.

    With the frames' energies E, the joints' rotations t and the shape's prior energy p, the energy
    is

        evidence / F sum_F (E + sum 1/2 (STIFFNESS t)^2) + p.

    Coordinates are those of the shape, (P,), then each pose's step, (n,).

    Args:
        start: Initial coordinates of the shape, (P,).
        bounds: Their smallest and largest values, (P, 2).
        skeleton: The skeleton with the initial shape.
        poses: Initial poses in the frames.
        evidence: Number of independent distances in all frames together, of which there are fewer
            than points: neighbouring points and frames are correlated.
    """

    def __init__(
        self,
        start: Array,
        bounds: Array,
        skeleton: Skeleton,
        poses: Sequence[Pose],
        evidence: float,
    ) -> None:
        self._charts = [TangentCoordinates(skeleton, pose) for pose in poses]
        self._weight = evidence / len(poses)
        self._spring = np.full(skeleton.dofs, STIFFNESS**2)
        self._spring[skeleton.free_dofs] = 0.0
        self._count = len(start)
        frames = np.arange(len(poses))[:, None]
        steps = self._count + frames * skeleton.dofs + np.arange(skeleton.dofs)
        self._steps: list[Indices] = list(steps)
        lower, upper = zip(*(chart.bounds() for chart in self._charts), strict=True)
        self.start = np.concatenate([start, *(chart.origin() for chart in self._charts)])
        self.lower = np.concatenate([bounds[:, 0], *lower])
        self.upper = np.concatenate([bounds[:, 1], *upper])

    @abstractmethod
    def prior(self, shape: Array) -> tuple[float, Array, Array]:
        """Returns the prior energy of a shape (P,), and its derivatives (P,) and (P, P)."""

    @abstractmethod
    def frames(self, shape: Array, poses: Sequence[Pose]) -> Iterable[FrameEnergy]:
        """Returns the energies of the frames.

        Args:
            shape: Coordinates of the shape, (P,).
            poses: Poses in the frames.
        """

    def poses(self, x: Array) -> tuple[Pose, ...]:
        """Returns the poses of the frames at coordinates x (m,)."""
        steps = zip(self._charts, self._steps, strict=True)
        return tuple(chart.pose(x[own]) for chart, own in steps)

    def value_and_gradient(self, x: Array) -> tuple[float, Array]:
        """Returns the energy at coordinates x (m,) and its gradient (m,)."""
        return self.normal_equations(x)[:2]

    def normal_equations(self, x: Array) -> tuple[float, Array, Array]:
        """Returns the energy, its gradient (m,) and the Gauss-Newton matrix (m, m)."""
        count = self._count
        gradient, matrix = np.zeros(len(x)), np.zeros((len(x), len(x)))
        value, gradient[:count], matrix[:count, :count] = self.prior(x[:count])
        energies = self.frames(x[:count], self.poses(x))
        for chart, own, frame in zip(self._charts, self._steps, energies, strict=True):
            step, both = x[own], np.concatenate([np.arange(count), own])
            to_step = frame.rows[:, count:] @ chart.jacobian(step)
            rows = np.column_stack([frame.rows[:, :count], to_step])
            value += self._weight * (frame.value + 0.5 * float(self._spring @ step**2))
            gradient[both] += self._weight * (frame.slopes @ rows)
            gradient[own] += self._weight * self._spring * step
            curved = frame.curvatures[:, None] * rows
            matrix[np.ix_(both, both)] += self._weight * (rows.T @ curved)
            matrix[own, own] += self._weight * self._spring
        return value, gradient, matrix

    def projected(self, x: Array) -> Array:
        """Returns coordinates (m,) with hinges and ball joints projected onto their limits."""
        x = np.clip(x, self.lower, self.upper)
        for chart, own in zip(self._charts, self._steps, strict=True):
            pose = chart.pose(x[own])
            within = chart.skeleton.limits.projected(pose)
            if within is not pose:
                x[own] = chart.vector(within)
        return x
