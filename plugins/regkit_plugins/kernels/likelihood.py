"""The mixture likelihood of the data under the placed Gaussians and outliers."""

from __future__ import annotations

from typing import Annotated, ClassVar, Literal

import numpy as np
from pydantic import Field

from regkit.gaussians.similarity import GaussianSimilarity
from regkit.gaussians.visible import seen
from regkit.interfaces import Kernel
from regkit.observation import Observation
from regkit.primitives import Gaussians, Placed, Primitives
from regkit.system.arrays import Array
from regkit.system.errors import DataError


class Likelihood(Kernel):
    """Likelihood of the data under a mixture of the placed Gaussians and uniform outliers.

    The energy is minus the mean logarithm of the density at the data points. The Gaussians compete
    for the points, so that a limb is not drawn to data that another explains already. They are
    mixed in proportion to the areas that they show to the camera in the start pose.
    """

    kind: Literal["likelihood"] = "likelihood"
    accepts: ClassVar[type[Primitives]] = Gaussians

    outliers: Annotated[float, Field(gt=0.0, lt=1.0)] = 0.1
    """Share of the data that is no part of the body, spread evenly over the data's box."""
    covariance: Literal["exact", "frozen"] = "exact"
    """Whether covariances turn with their segments, or keep their orientation of the start pose."""

    def bind(
        self, observation: Observation, start: Placed[Gaussians], *, smoothing: float = 0.0
    ) -> BoundLikelihood:
        """Bind the kernel to a frame's data."""
        return BoundLikelihood(self, observation, start, smoothing)


class BoundLikelihood(GaussianSimilarity):
    """The likelihood bound to a frame."""

    volume_power = 0.0

    def __init__(
        self,
        kernel: Likelihood,
        observation: Observation,
        start: Placed[Gaussians],
        smoothing: float,
    ) -> None:
        mixing = start.primitives.weights * seen(start, observation.camera).areas()
        share = (1.0 - kernel.outliers) / (2.0 * np.pi) ** 1.5
        super().__init__(
            observation,
            start,
            data_weights=observation.weights / observation.weights.sum(),
            log_weights=np.log(share * mixing / mixing.sum()),
            smoothing=smoothing,
            frozen=kernel.covariance == "frozen",
        )
        self._background = kernel.outliers / box_volume(observation)

    def weigh(self, densities: Array, data_weights: Array) -> float:
        """Returns a pair weighs by the Gaussian's share of the point, as in an E-step."""
        total = densities.sum(axis=0) + self._background * data_weights
        densities *= data_weights / total
        return -float(data_weights @ np.log(total / data_weights))

    def inliers(self, densities: Array, data_weights: Array) -> Array:
        """Returns the share of each point that is no outlier's."""
        total = densities.sum(axis=0)
        return np.asarray(total / (total + self._background * data_weights))


def box_volume(observation: Observation) -> float:
    """Volume [m^3] of the data's box; a flat cloud counts as a tenth as deep as it is long.

    Raises:
        DataError: If all points coincide.
    """
    sides = np.ptp(observation.points, axis=0)
    if not sides.any():
        raise DataError(
            f"all {len(observation.points)} points of the frame coincide; a pose needs a cloud "
            "that extends in space"
        )
    return float(np.maximum(sides, 0.1 * sides.max()).prod())
