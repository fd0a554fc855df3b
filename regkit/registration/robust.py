"""Robust losses: large residuals count little or not at all."""

from __future__ import annotations

from abc import ABC, abstractmethod
from dataclasses import dataclass
from typing import ClassVar, Literal

import numpy as np

from regkit.config.model import Model
from regkit.config.quantities import Length
from regkit.system.arrays import Array
from regkit.system.errors import ConfigError


class Robust(Model):
    """A robust loss and its scale, which separates inliers from outliers."""

    loss: Literal["squares", "huber", "tukey", "geman_mcclure"] = "geman_mcclure"
    """Half the square near zero; beyond a few scales a line (huber), a constant (tukey) or an
    approach to a constant (geman_mcclure)."""
    scale: Length | None = None
    """Standard deviation of the inliers' residuals [m]; by default estimated from each frame's
    residuals at the start of its registration."""

    def bound(
        self, residuals: Array | None = None, *, least: float = 0.0, smoothing: float = 0.0
    ) -> Loss:
        """Returns the loss with the scale of the data, one function for the whole solution.

        Args:
            residuals: Residuals at the start, (N,) [m]; required without ``scale``.
            least: Lower bound of the estimated scale [m], such as the standard deviation of the
                data: residuals that happen to be equal do not reveal the noise.
            smoothing: Standard deviation that widens the scale [m].

        Raises:
            ConfigError: If neither ``scale`` nor residuals are given.
        """
        scale = self.scale
        if scale is None:
            if residuals is None:
                raise ConfigError("robust.scale is needed: the kernel does not estimate it")
            scale = max(median_scale(residuals), least)
        return self.kind(float(np.hypot(scale, smoothing)))

    @property
    def kind(self) -> type[Loss]:
        """The loss without its scale."""
        return _LOSSES[self.loss]


def median_scale(residuals: Array) -> float:
    """Returns the standard deviation of zero-mean normal residuals (N,) from their median size.

    This is the median absolute deviation (MAD) from zero, the model's prediction. It tolerates up
    to half of the residuals as outliers.
    """
    return float(np.median(np.abs(residuals))) / _NORMAL_QUARTILE


@dataclass(frozen=True)
class Loss(ABC):
    """A function rho of a residual that is near half its square, in units of the scale.

    Attributes:
        scale: Standard deviation s of the residuals [m].
        tuning: Tuning constant c beyond which residuals are outliers, in units of the scale; its
            value gives a mean of normal residuals 95 % of the efficiency of squares.
    """

    scale: float
    tuning: ClassVar[float]

    def values(self, residuals: Array) -> Array:
        """Returns rho of residuals r (N,) [m], dimensionless: r^2 / (2 s^2) near zero."""
        return self._values((residuals / self.scale) ** 2)

    def gradient(self, residuals: Array) -> Array:
        """Returns the derivative of rho, (N,) [1/m]."""
        return self.weights(residuals) * residuals

    def weights(self, residuals: Array) -> Array:
        """Returns rho'(r) / r, the Gauss-Newton weights, (N,) [1/m^2]: 1 / s^2 near zero."""
        return self.inlier_probability(residuals) / self.scale**2

    def inlier_probability(self, residuals: Array) -> Array:
        """Returns the weights of residuals (N,) [m] relative to a small residual's, from 0 to 1."""
        return self._relative_weights((residuals / self.scale) ** 2)

    @abstractmethod
    def _values(self, squares: Array) -> Array:
        """Returns rho(u), (N,), from u^2."""

    @abstractmethod
    def _relative_weights(self, squares: Array) -> Array:
        """Returns psi(u) / u, (N,), from u^2."""


class Squares(Loss):
    """``u^2 / 2``."""

    tuning = np.inf

    def _values(self, squares: Array) -> Array:
        return 0.5 * squares

    def _relative_weights(self, squares: Array) -> Array:
        return np.ones_like(squares)


class Huber(Loss):
    """``u^2 / 2`` up to c, then ``c (|u| - c/2)``."""

    tuning = 1.345

    def _values(self, squares: Array) -> Array:
        size = np.sqrt(squares)
        inner = np.minimum(size, self.tuning)
        return np.asarray(inner * (size - 0.5 * inner))

    def _relative_weights(self, squares: Array) -> Array:
        return np.asarray(self.tuning / np.sqrt(np.maximum(squares, self.tuning**2)))


class Tukey(Loss):
    """``c^2/6 (1 - (1 - (u/c)^2)^3)`` up to c, then constant: Tukey's biweight."""

    tuning = 4.685

    def _values(self, squares: Array) -> Array:
        rest = np.maximum(1.0 - squares / self.tuning**2, 0.0)
        return np.asarray(self.tuning**2 / 6.0 * (1.0 - rest**3))

    def _relative_weights(self, squares: Array) -> Array:
        return np.asarray(np.maximum(1.0 - squares / self.tuning**2, 0.0) ** 2)


class GemanMcClure(Loss):
    """``u^2 / 2 / (1 + (u/c)^2)``, which approaches c^2 / 2."""

    tuning = 3.787

    def _values(self, squares: Array) -> Array:
        return 0.5 * squares / (1.0 + squares / self.tuning**2)

    def _relative_weights(self, squares: Array) -> Array:
        return 1.0 / (1.0 + squares / self.tuning**2) ** 2


class PseudoHuber(Loss):
    """``sqrt(1 + u^2) - 1``: half the square near zero, linear far away."""

    tuning = 1.0

    def _values(self, squares: Array) -> Array:
        return np.asarray(np.sqrt(1.0 + squares) - 1.0)

    def _relative_weights(self, squares: Array) -> Array:
        return np.asarray(1.0 / np.sqrt(1.0 + squares))


_LOSSES: dict[str, type[Loss]] = {
    "squares": Squares,
    "huber": Huber,
    "tukey": Tukey,
    "geman_mcclure": GemanMcClure,
}

_NORMAL_QUARTILE = 0.6744897501960817
"""Half of standard normal deviates have a smaller absolute value."""
