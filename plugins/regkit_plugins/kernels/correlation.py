"""The paper's similarity: the overlap of the template's Gaussians with those of the data."""

from __future__ import annotations

from typing import ClassVar, Literal

import numpy as np

from regkit.arrays import Array
from regkit.interfaces import Kernel, Response, Similarity
from regkit.observation import Observation
from regkit.primitives import Gaussians, Placed, Primitives


class Correlation(Kernel):
    """Spatial correlation of a sum of Gaussians, generalized or not, with that of the data.

    The energy is minus the paper's E (eq. 5) divided by the integral of the data's Gaussians, that
    is, minus the mean density of the template over the data: a number without a unit, whose size
    does not depend on how many points there are.
    """

    kind: Literal["correlation"] = "correlation"
    accepts: ClassVar[type[Primitives]] = Gaussians

    covariance: Literal["exact", "frozen"] = "exact"
    """Whether covariances turn with their segments, or keep their orientation of the start pose, as
    the paper has it (after eq. 11)."""

    def against(
        self, observation: Observation, start: Placed[Gaussians], *, blur: float = 0.0
    ) -> CorrelationSimilarity:
        """Bind the kernel to a frame's data."""
        axes = start.axes if self.covariance == "frozen" else None
        return CorrelationSimilarity(observation, start.primitives, blur, axes)


class CorrelationSimilarity(Similarity):
    """Eq. 8 in closed form, its value and derivative from ten moments of the data.

    With d = m_i - y_j and S = C_i + (sigma_j^2 + blur^2) I, eq. 8 reads

        E_ij = (2 pi)^(3/2) sqrt(|C_i| sigma_j^6 / |S|) exp(-1/2 d^T S^-1 d).

    The exponent is linear in ten features of the data (1, y, y y^T). So all exponents are one
    matrix product, the exponential is taken in place, and a second product with the same features
    gives the moments sum K, sum K y and sum K y y^T, which hold all that a Gaussian needs of the
    data. Data with different variances are treated in turn.

    Args:
        observation: The data.
        gaussians: What will be placed.
        blur: Standard deviation [m] of the Gaussian that smooths the data.
        frozen: Axes (K, 3, 3) that the covariances keep, or None if they turn.
    """

    def __init__(
        self, observation: Observation, gaussians: Gaussians, blur: float, frozen: Array | None
    ) -> None:
        self._frozen = frozen
        # The features cancel badly far from the origin, so they are taken about the data's centre.
        self._centre = observation.points.mean(axis=0)
        variances, group = np.unique(observation.variances, return_inverse=True)
        masses = variances**1.5  # The integral of a Gaussian but for (2 pi)^(3/2).
        weights = observation.weights * masses[group]
        weights = weights / weights.sum()
        self._groups = [
            _Group(
                gaussians,
                points=observation.points[group == index] - self._centre,
                weights=weights[group == index],
                variance=variance + blur**2,
            )
            for index, variance in enumerate(variances)
        ]

    def __call__(self, placed: Placed[Gaussians]) -> Response:
        """The energy, and the wrench on each Gaussian about its mean."""
        axes = placed.axes if self._frozen is None else self._frozen
        means = placed.centres - self._centre
        energy, wrenches = self._groups[0].pull(means, axes)
        for group in self._groups[1:]:
            more, further = group.pull(means, axes)
            energy += more
            wrenches += further
        if self._frozen is not None:
            wrenches[:, 3:] = 0.0
        return Response(energy, wrenches)


class _Group:
    """Data Gaussians of one variance, against the Gaussians of the template.

    S is diagonal in the axes of a template's Gaussian, so the amplitudes do not depend on the pose.
    With homogeneous coordinates h = (y, 1) and Z = [I, -m], so that Z h = y - m, the exponent is
    the quadratic form -1/2 h^T (Z^T S^-1 Z) h, and the moments are the matrix sum K h h^T.
    """

    def __init__(
        self, gaussians: Gaussians, points: Array, weights: Array, variance: float
    ) -> None:
        sums = gaussians.scales**2 + variance
        self._precisions = (1.0 / sums)[:, None, :]
        # |C| / |S|, as logarithms for the exponent.
        ratios = np.log(gaussians.scales**2 / sums).sum(axis=1)
        self._log_amplitudes = np.log(gaussians.weights) + 0.5 * ratios

        x, y, z = points.T
        ones = np.ones(len(points))
        self._features = np.array([x * x, y * y, z * z, x * y, x * z, y * z, x, y, z, ones])
        self._weighted = (self._features * weights).T
        self._kernel = np.empty((len(gaussians), len(points)))
        self._relative = np.zeros((len(gaussians), 3, 4))
        self._relative[:, :, :3] = np.eye(3)

        radius = np.sqrt((points**2).sum(axis=1).max())
        reach = np.sqrt(-2.0 * (_FLOOR - self._log_amplitudes) * sums.min(axis=1))
        self._safe = np.maximum(reach - radius, 0.0) ** 2
        self._floor = np.full(len(points), _FLOOR)

    def pull(self, means: Array, axes: Array) -> tuple[float, Array]:
        """Minus the overlap, and its derivative (K, 6) to the Gaussians' motions."""
        relative, kernel = self._relative, self._kernel
        relative[:, :, 3] = -means
        turned = relative.transpose(0, 2, 1)
        scaled = (axes * self._precisions) @ (axes.transpose(0, 2, 1) @ relative)  # S^-1 Z
        quadric = (turned @ scaled).reshape(-1, 16)
        coefficients = quadric.take(_ENTRIES, axis=1) * _FACTORS
        coefficients[:, 9] += self._log_amplitudes
        np.matmul(coefficients, self._features, out=kernel)
        if self._may_underflow(means):
            np.maximum(kernel, self._floor, out=kernel)
        np.exp(kernel, out=kernel)
        moments = kernel @ self._weighted

        # With u = S^-1 (m - y), dK/dm = -K u. The exact derivative to the rotation is the same
        # force applied at the product's mean m - C u, or just as well at y, which lies on its line
        # of action: m - y = C u + sigma^2 u. So sum K S^-1 (y - m) h^T holds both.
        pulls = scaled @ moments.take(_MATRIX, axis=1).reshape(-1, 4, 4)
        wrenches = np.empty((len(means), 6))
        np.negative(pulls[:, :, 3], out=wrenches[:, :3])
        levers = (pulls @ turned).reshape(-1, 9)  # sum K u (m - y)^T
        np.subtract(levers.take(_AFTER, axis=1), levers.take(_BEFORE, axis=1), out=wrenches[:, 3:])
        return -float(moments[:, 9].sum()), wrenches

    def _may_underflow(self, means: Array) -> bool:
        """Whether a mean may be so far from a point that the exponent is below the floor."""
        return bool(((means * means).sum(axis=1) > self._safe).any())


_FLOOR = -600.0
"""Exponents below this are raised to it: such an overlap is nothing (1e-261), but numbers near
underflow take the processor up to a hundred times as long."""

_ENTRIES = np.array([0, 5, 10, 1, 2, 6, 3, 7, 11, 15])
"""Where a flattened symmetric 4x4 matrix has its ten entries, in the order of the features."""

_FACTORS = np.array([-0.5, -0.5, -0.5, -1.0, -1.0, -1.0, -1.0, -1.0, -1.0, -0.5])
"""Factors of those entries in the exponent -1/2 h^T Q h."""

_MATRIX = np.array([0, 3, 4, 6, 3, 1, 5, 7, 4, 5, 2, 8, 6, 7, 8, 9])
"""Where the ten moments stand in the flattened matrix sum K h h^T."""

_AFTER, _BEFORE = np.array([5, 6, 1]), np.array([7, 2, 3])
"""Entries of a flattened matrix whose differences are its axial vector."""
