"""The likelihood kernel: a mixture of the placed Gaussians and outliers."""

from __future__ import annotations

from typing import Annotated, ClassVar, Literal

import numpy as np
from pydantic import Field

from regkit.gaussians.compiled_similarity import COLUMNS, shows_surface
from regkit.gaussians.similarity import GaussianSimilarity
from regkit.gaussians.visible import seen
from regkit.interfaces import CompiledEnergy, Kernel
from regkit.observation import Observation
from regkit.primitives import Gaussians, Placed, Primitives
from regkit.system.arrays import Array
from regkit.system.errors import DataError
from regkit_plugins.kernels.likelihood.compiled import bind, explain, respond


class Likelihood(Kernel):
    """Likelihood of the data under a mixture of the placed Gaussians and uniform outliers.

    The energy is minus the mean log-density at the data points. The Gaussians compete for the
    points, so data that one limb explains do not attract another. Their mixture weights are
    proportional to the areas visible to the camera in the start pose.
    """

    kind: Literal["likelihood"] = "likelihood"
    accepts: ClassVar[type[Primitives]] = Gaussians

    outliers: Annotated[float, Field(gt=0.0, lt=1.0)] = 0.1
    """Fraction of outliers in the data, distributed uniformly over the data's bounding box."""
    covariance: Literal["exact", "frozen"] = "exact"
    """Whether covariances rotate with their segments, or keep their orientation at the start."""

    def bind(
        self, observation: Observation, start: Placed[Gaussians], *, smoothing: float = 0.0
    ) -> BoundLikelihood:
        """Binds the kernel to the data of a frame."""
        return BoundLikelihood(self, observation, start, smoothing)

    def compiled(self, primitives: Primitives) -> CompiledEnergy | None:
        """Returns the kernel as compiled functions, for Gaussians."""
        surface = shows_surface(primitives)
        if surface is None:
            return None
        numbers = (surface, self.covariance == "frozen", self.outliers)
        state = (len(primitives) + 1, COLUMNS)
        return CompiledEnergy(respond, numbers, bind=bind, state=state, explain=explain)


class BoundLikelihood(GaussianSimilarity):
    """``Likelihood`` bound to a frame.

    Args:
        kernel: The kernel.
        observation: The data.
        start: The Gaussians in the start pose.
        smoothing: Standard deviation of the Gaussian that smooths the data [m].
    """

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
        """Returns the energy; a pair's weight is the Gaussian's posterior probability (E-step)."""
        total = densities.sum(axis=0) + self._background * data_weights
        densities *= data_weights / total
        return -float(data_weights @ np.log(total / data_weights))

    def inliers(self, densities: Array, data_weights: Array) -> Array:
        """Returns the probability that a point is not an outlier, (N,)."""
        total = densities.sum(axis=0)
        return np.asarray(total / (total + self._background * data_weights))


def box_volume(observation: Observation) -> float:
    """Returns the volume [m^3] of the data's bounding box.

    Each side counts as at least a tenth of the longest, so that a flat cloud has a volume.

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
