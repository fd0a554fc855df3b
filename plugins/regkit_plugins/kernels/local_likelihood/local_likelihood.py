"""The local-likelihood kernel: each point under its nearest Gaussians, for many of both."""

from __future__ import annotations

from typing import Annotated, ClassVar, Literal

import numpy as np
from pydantic import Field

from regkit.clouds import normals
from regkit.clouds.tree import Tree
from regkit.interfaces import Kernel, Response, Similarity
from regkit.observation import Observation
from regkit.primitives import Gaussians, Placed, Primitives
from regkit.system.arrays import Array
from regkit_plugins.kernels.likelihood import box_volume
from regkit_plugins.kernels.local_likelihood.compiled import flattened, local_mixture
from regkit_plugins.kernels.local_likelihood.rigid import LocalRigidComparison


class LocalLikelihood(Kernel):
    """Likelihood of the data under a mixture of each point's nearest Gaussians and outliers.

    A variant of ``likelihood`` for clouds against clouds: each point is compared only with the
    Gaussians nearest to it in the start pose, so that time and memory grow with the number of
    points and not of all pairs. The data are Gaussians flattened along their surface, as in
    generalized ICP (Segal, Haehnel, Thrun, Generalized-ICP, 2009, eq. 2). The camera is ignored.
    """

    kind: Literal["local_likelihood"] = "local_likelihood"
    accepts: ClassVar[type[Primitives]] = Gaussians

    neighbours: Annotated[int, Field(ge=1, le=1000)] = 6
    """Number of Gaussians that a point is compared with."""
    outliers: Annotated[float, Field(gt=0.0, lt=1.0)] = 0.5
    """Fraction of outliers in the data, distributed uniformly over the data's bounding box."""
    flatness: Annotated[float, Field(ge=1e-3, le=1.0)] = 0.2
    """Standard deviation of a data Gaussian along the normal, as a fraction of that along the
    surface; 1 makes it isotropic."""

    def bind(
        self, observation: Observation, start: Placed[Gaussians], *, smoothing: float = 0.0
    ) -> BoundLocalLikelihood:
        """Binds the kernel to the data of a frame, with the neighbours in the start pose."""
        return BoundLocalLikelihood(self, observation, start, smoothing)

    def bind_rigid(
        self, observation: Observation, primitives: Gaussians, *, smoothing: float = 0.0
    ) -> LocalRigidComparison:
        """Binds the kernel to the data and to the Gaussians of a rigid body."""
        return LocalRigidComparison.of(
            points=observation.points,
            directions=_directions(observation),
            variances=observation.variances + smoothing**2,
            weights=observation.weights / observation.weights.sum(),
            flatness=self.flatness,
            primitives=primitives,
            mixing=self.mixing(primitives),
            background=self.outliers / box_volume(observation),
            near=min(self.neighbours, len(primitives)),
        )

    def mixing(self, primitives: Gaussians) -> Array:
        """Returns the mixture weights divided by (2 pi)^(3/2), (K,)."""
        weights = primitives.weights / primitives.weights.sum()
        return np.asarray((1.0 - self.outliers) / (2.0 * np.pi) ** 1.5 * weights)


class BoundLocalLikelihood(Similarity):
    """The energy -sum_j w_j log(sum_i c_i |S|^(-1/2) exp(-1/2 q^T S^-1 q) + c_0).

    Here q = y_j - m_i and S = C_i + D_j; j runs over the data, i over the neighbours of j. With
    u = S^-1 q and the posterior probability a of a pair, the derivative to the translation of the
    Gaussian is -a u. The derivative to its rotation, with the same force at the mean of the product
    m + C u and the derivative of log |S|, is

        a (u x C u - vee(C S^-1 - S^-1 C)), where vee [v]x = v.

    The Gauss-Newton block is that of the material at the mean of the product, with stiffness S^-1.

    Args:
        kernel: The kernel.
        observation: The data.
        start: The Gaussians in the start pose.
        smoothing: Standard deviation of the Gaussian that smooths the data [m].
    """

    def __init__(
        self,
        kernel: LocalLikelihood,
        observation: Observation,
        start: Placed[Gaussians],
        smoothing: float,
    ) -> None:
        self._points = observation.points
        self._weights = observation.weights / observation.weights.sum()
        variances = observation.variances + smoothing**2
        self._covariances = flattened(variances, _directions(observation), kernel.flatness)
        tree, near = Tree.of(start.centres), min(kernel.neighbours, len(start))
        self._neighbours = tree.order[tree.nearest(self._points, near)[1]]
        self._mixing = kernel.mixing(start.primitives)
        self._background = kernel.outliers / box_volume(observation)

    def __call__(self, placed: Placed[Gaussians], *, curvature: bool = False) -> Response:
        """Returns the energy, wrenches about the Gaussians' centres, and Gauss-Newton blocks."""
        energy, wrenches, blocks, _ = self._mixture(placed, curvature)
        return Response(energy, wrenches, blocks if curvature else None)

    def inlier_probability(self, placed: Placed[Gaussians]) -> Array:
        """Returns the probability that each point is not an outlier, (N,)."""
        return self._mixture(placed, curvature=False)[3]

    def _mixture(
        self, placed: Placed[Gaussians], curvature: bool
    ) -> tuple[float, Array, Array, Array]:
        return local_mixture(
            self._points,
            self._weights,
            self._covariances,
            self._neighbours,
            placed.centres,
            placed.covariances(),
            self._mixing,
            self._background,
            curvature,
        )


def _directions(observation: Observation) -> Array:
    """Returns the normals at the data, (N, 3), estimated if the observation has none."""
    return normals(observation.points) if observation.normals is None else observation.normals
