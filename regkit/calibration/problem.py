"""The joint problem: one body's proportions and its poses in several frames."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

import numpy as np

from regkit.body import Body
from regkit.calibration.cloud import Cloud
from regkit.calibration.jacobian import ProportionJacobian
from regkit.calibration.shape import Shape
from regkit.calibration.shared_shape import FrameEnergy, SharedShapeProblem
from regkit.skeleton import Pose
from regkit.system.arrays import Array

CUTOFF = 2.0
"""Cutoff of distances in units of the median, which covers the noise of the data and the body's
misfit."""

RANGE = 0.06
"""A point's ray is traced within this fraction of the body's size."""


EVIDENCE = 1000.0
"""Number of independent distances in all frames together."""


class SubjectProblem(SharedShapeProblem):
    """Surface distances in all frames.

    With the distances g in units of the cutoff and their weights w, the energy of a frame is
    sum 1/2 w log(1 + g^2). The logarithm, Cauchy's loss, gives outliers little weight. The shape
    parameters have independent priors, which are springs.

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
        free = np.full(len(shape), np.inf)
        super().__init__(start, np.column_stack([-free, free]), body.skeleton, poses, EVIDENCE)

    def shape(self, x: Array) -> Array:
        """Returns the shape parameters (1 + 2 G) in coordinates x (m,)."""
        return x[: len(self._shape)]

    def prior(self, shape: Array) -> tuple[float, Array, Array]:
        """Returns the energy of the springs, and its derivatives."""
        springs = self._shape.springs()
        return 0.5 * float(springs @ shape**2), springs * shape, np.diag(springs)

    def frames(self, shape: Array, poses: Sequence[Pose]) -> Iterator[FrameEnergy]:
        """Yields the energies of the frames."""
        body = self._shape.body(shape)
        for cloud, pose in zip(self._clouds, poses, strict=True):
            placement = body.place(pose)
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
            rows = np.column_stack([factors.sum(axis=1), factors, turns]) / self._cutoff
            tensions = weights / (1.0 + distances**2)
            value = 0.5 * float(weights @ np.log1p(distances**2))
            yield FrameEnergy(value, rows, tensions * distances, tensions)

    def _median_distance(self, body: Body, poses: Sequence[Pose]) -> float:
        """Returns the median distance of all points to the surface [m]."""
        lengths = [
            cloud.data_to_model(
                body.capsules.place(body.place(pose).transforms), self._range
            ).lengths
            for cloud, pose in zip(self._clouds, poses, strict=True)
        ]
        return float(np.median(np.abs(np.concatenate(lengths))))
