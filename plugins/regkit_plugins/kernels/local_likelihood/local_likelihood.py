"""The likelihood of the data under the Gaussians nearest to each point, for many of both."""

from __future__ import annotations

from typing import Annotated, ClassVar, Literal

import numpy as np
from pydantic import Field

from regkit.clouds import normals
from regkit.interfaces import Kernel, Response, Similarity
from regkit.observation import Observation
from regkit.primitives import Gaussians, Placed, Primitives
from regkit.system.arrays import Array
from regkit_plugins.kernels.likelihood import box_volume
from regkit_plugins.kernels.local_likelihood.compiled import flattened, local_mixture


class LocalLikelihood(Kernel):
    """Likelihood of the data under a mixture of each point's nearest Gaussians and outliers.

    As ``likelihood``, for clouds against clouds: a point is compared with the few Gaussians that
    are nearest to it in the start pose, so that time and memory grow with the number of points and
    not with that of all pairs. The data are Gaussians too, flattened along the surface that they
    lie on, as in generalized ICP (Segal, Haehnel, Thrun, Generalized-ICP, 2009, eq. 2); a camera
    plays no part.
    """

    kind: Literal["local_likelihood"] = "local_likelihood"
    accepts: ClassVar[type[Primitives]] = Gaussians

    neighbours: Annotated[int, Field(ge=1)] = 6
    """With how many Gaussians a point is compared."""
    outliers: Annotated[float, Field(gt=0.0, lt=1.0)] = 0.5
    """Share of the data that is no part of the body, spread evenly over the data's box."""
    flatness: Annotated[float, Field(gt=0.0, le=1.0)] = 0.2
    """Standard deviation of a data Gaussian along the surface's normal, as a part of that in the
    surface; 1 makes it round."""

    def bind(
        self, observation: Observation, start: Placed[Gaussians], *, smoothing: float = 0.0
    ) -> BoundLocalLikelihood:
        """Bind the kernel to a frame's data, with the neighbours of the start pose."""
        return BoundLocalLikelihood(self, observation, start, smoothing)


class BoundLocalLikelihood(Similarity):
    """The energy -sum_j w_j log(sum_i c_i |S|^(-1/2) exp(-1/2 q^T S^-1 q) + c_0).

    Here q = y_j - m_i and S = C_i + D_j; j runs over the data, i over the neighbours of j. With
    u = S^-1 q and a pair's share a of its point, the derivative to the Gaussian's translation is
    -a u. That to its rotation is of the same force at the product's mean m + C u, and of log |S|:

        a (u x C u - vee(C S^-1 - S^-1 C)), where vee [v]x = v.

    The Gauss-Newton block is that of the material at the product's mean, which feels S^-1 there.
    """

    def __init__(
        self,
        kernel: LocalLikelihood,
        observation: Observation,
        start: Placed[Gaussians],
        smoothing: float,
    ) -> None:
        from scipy.spatial import KDTree

        self._points = observation.points
        self._weights = observation.weights / observation.weights.sum()
        directions = observation.normals
        if directions is None:
            directions = normals(observation.points)
        variances = observation.variances + smoothing**2
        self._covariances = flattened(variances, directions, kernel.flatness)
        near = min(kernel.neighbours, len(start))
        _, neighbours = KDTree(start.centres).query(self._points, near)
        self._neighbours = np.asarray(neighbours).reshape(len(self._points), near)
        mixing = start.primitives.weights / start.primitives.weights.sum()
        self._mixing = (1.0 - kernel.outliers) / (2.0 * np.pi) ** 1.5 * mixing
        self._background = kernel.outliers / box_volume(observation)

    def __call__(self, placed: Placed[Gaussians], *, curvature: bool = False) -> Response:
        """The energy, the wrenches about the Gaussians' centres, and the Gauss-Newton blocks."""
        energy, wrenches, blocks, _ = self._mixture(placed, curvature)
        return Response(energy, wrenches, blocks if curvature else None)

    def inlier_probability(self, placed: Placed[Gaussians]) -> Array:
        """Returns the share of each point that is no outlier's, (N,)."""
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
