"""The joint problem: one body's proportions and its poses in several frames."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from regkit.body import Body
from regkit.calibration.cloud import Cloud
from regkit.calibration.jacobian import ProportionJacobian
from regkit.calibration.shape import Shape
from regkit.interfaces import Problem
from regkit.registration import TangentCoordinates
from regkit.skeleton import Pose
from regkit.system.arrays import Array, Indices

CUTOFF = 2.0
"""Cutoff of distances in units of the median, which covers the noise of the data and the body's
misfit."""

RANGE = 0.06
"""A point's ray is traced within this fraction of the body's size."""

EVIDENCE = 1000.0
"""Number of independent distances in all frames together: neighbouring points and frames are
correlated."""

STIFFNESS = 0.05
"""Weight of a joint's rotation [rad] against a distance [cutoff]; a joint without data stays."""


class SubjectProblem(Problem):
    """Surface distances in all frames, with priors on joint rotations and proportions.

    With the distances g in units of the cutoff, their weights w, the joints' rotations t and the
    shape parameters s with standard deviations u, the energy over F frames is

        EVIDENCE / F sum_F (sum 1/2 w log(1 + g^2) + sum 1/2 (STIFFNESS t)^2) + sum 1/2 (s / u)^2.

    The logarithm, Cauchy's loss, gives outliers little weight.

    Args:
        shape: The body's proportions.
        start: Initial shape parameters, (1 + 2 G).
        clouds: Data of F frames.
        poses: Initial poses of the body in these frames.
    """

    def __init__(
        self, shape: Shape, start: Array, clouds: Sequence[Cloud], poses: Sequence[Pose]
    ) -> None:
        self._shape, self._clouds = shape, clouds
        body = shape.body(start)
        self._range = RANGE * body.size
        self._cutoff = CUTOFF * self._median_distance(body, poses)
        self._charts = [TangentCoordinates(body.skeleton, pose) for pose in poses]
        self._weight = EVIDENCE / len(clouds)
        self._spring = np.full(len(self._charts[0].origin()), STIFFNESS**2)
        self._spring[body.skeleton.free_dofs] = 0.0
        lower, upper = zip(*(chart.bounds() for chart in self._charts), strict=True)
        free = np.full(len(shape), np.inf)
        self.start = np.concatenate([start, *(chart.origin() for chart in self._charts)])
        self.lower = np.concatenate([-free, *lower])
        self.upper = np.concatenate([free, *upper])

    def shape(self, x: Array) -> Array:
        """Returns the shape parameters (1 + 2 G) in coordinates x (m,)."""
        return x[: len(self._shape)]

    def poses(self, x: Array) -> tuple[Pose, ...]:
        """Returns the poses of the frames at coordinates x (m,)."""
        indices = self._step_indices()
        return tuple(chart.pose(x[own]) for chart, own in zip(self._charts, indices, strict=True))

    def value_and_gradient(self, x: Array) -> tuple[float, Array]:
        """Returns the energy at coordinates x (m,) and its gradient (m,)."""
        return self.normal_equations(x)[:2]

    def normal_equations(self, x: Array) -> tuple[float, Array, Array]:
        """Returns the energy, its gradient (m,) and the Gauss-Newton matrix (m, m)."""
        shape, springs = self.shape(x), self._shape.springs()
        body = self._shape.body(shape)
        value = 0.5 * float(springs @ shape**2)
        gradient, matrix = np.zeros(len(x)), np.zeros((len(x), len(x)))
        gradient[: len(shape)] = springs * shape
        matrix[: len(shape), : len(shape)] = np.diag(springs)
        shapes = np.arange(len(shape))
        for chart, cloud, own in zip(self._charts, self._clouds, self._step_indices(), strict=True):
            part = self._frame(body, chart, cloud, x[own])
            both = np.concatenate([shapes, own])
            value += self._weight * part[0]
            gradient[both] += self._weight * part[1]
            matrix[np.ix_(both, both)] += self._weight * part[2]
        return value, gradient, matrix

    def projected(self, x: Array) -> Array:
        """Returns coordinates (m,) with hinges and ball joints projected onto their limits."""
        x = np.clip(x, self.lower, self.upper)
        for chart, own in zip(self._charts, self._step_indices(), strict=True):
            pose = chart.pose(x[own])
            within = chart.skeleton.limits.projected(pose)
            if within is not pose:
                x[own] = chart.vector(within)
        return x

    def _frame(
        self, body: Body, chart: TangentCoordinates, cloud: Cloud, step: Array
    ) -> tuple[float, Array, Array]:
        """Returns a frame's energy and derivatives, to the shape and then to the pose's step."""
        placement = body.place(chart.pose(step))
        capsules = body.capsules.place(placement.transforms)
        proportions = ProportionJacobian(body, placement, self._shape.groups)
        to_model = cloud.data_to_model(capsules, self._range)
        to_data, visible = cloud.model_to_data(capsules)
        sides = (to_model, to_data)
        distances = np.concatenate([side.lengths for side in sides]) / self._cutoff
        even = np.full(len(to_model.lengths), 1.0 / len(to_model.lengths))
        weights = np.concatenate([even, visible])
        factors = np.concatenate([proportions.rows(side) for side in sides])
        turns = np.concatenate([side.rows(placement) for side in sides])
        rows = np.column_stack([factors.sum(axis=1), factors, turns @ chart.jacobian(step)])
        rows /= self._cutoff
        tensions = weights / (1.0 + distances**2)
        spring = np.concatenate([np.zeros(len(self._shape)), self._spring])
        rest = np.concatenate([np.zeros(len(self._shape)), step])
        energy = 0.5 * float(weights @ np.log1p(distances**2) + spring @ rest**2)
        gradient = (tensions * distances) @ rows + spring * rest
        return energy, gradient, rows.T @ (tensions[:, None] * rows) + np.diag(spring)

    def _median_distance(self, body: Body, poses: Sequence[Pose]) -> float:
        """Returns the median distance of all points to the surface [m]."""
        lengths = [
            cloud.data_to_model(
                body.capsules.place(body.place(pose).transforms), self._range
            ).lengths
            for cloud, pose in zip(self._clouds, poses, strict=True)
        ]
        return float(np.median(np.abs(np.concatenate(lengths))))

    def _step_indices(self) -> list[Indices]:
        """Returns the indices of each pose's step among the coordinates."""
        dofs = len(self._spring)
        first = len(self._shape)
        return [first + frame * dofs + np.arange(dofs) for frame in range(len(self._charts))]
