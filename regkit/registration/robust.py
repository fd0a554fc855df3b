"""Robust losses: residuals that are too large to be the model's count little, or nothing more."""

from __future__ import annotations

from abc import ABC, abstractmethod
from dataclasses import dataclass
from typing import Annotated, ClassVar, Literal

import numpy as np
from pydantic import Field

from regkit.config.model import Model
from regkit.system.arrays import Array
from regkit.system.errors import ConfigError


class Robust(Model):
    """What residuals cost, and from what size on they are taken for outliers."""

    loss: Literal["squares", "huber", "tukey", "geman_mcclure"] = "geman_mcclure"
    """Half the square; or that up to some scales, and from there on a line (huber), a constant
    (tukey), or towards a constant (geman_mcclure)."""
    scale: Annotated[float, Field(gt=0.0)] | None = None
    """Standard deviation of the residuals that are the model's own [m]; without it, that of each
    frame's residuals where its registration begins."""

    def bound(
        self, residuals: Array | None = None, *, least: float = 0.0, smoothing: float = 0.0
    ) -> Loss:
        """The loss whose scale is that of the data, one function for the whole solution.

        Args:
            residuals: At the start, (N,) [m]; they are needed where no scale is given.
            least: The least estimated scale [m], such as the standard deviation of the data:
                residuals that happen to be equal say nothing about noise.
            smoothing: A standard deviation [m] that widens the scale.

        Raises:
            ConfigError: If the scale is neither given nor follows from residuals.
        """
        scale = self.scale
        if scale is None:
            if residuals is None:
                raise ConfigError("robust.scale is needed: the kernel does not estimate it")
            scale = max(median_scale(residuals), least)
        return _LOSSES[self.loss](float(np.hypot(scale, smoothing)))


def median_scale(residuals: Array) -> float:
    """The standard deviation of normal residuals (N,) about zero, by their median absolute value.

    It is the median absolute deviation (MAD) from zero, which is what the model predicts; half of
    the residuals may be outliers.
    """
    return float(np.median(np.abs(residuals))) / _NORMAL_QUARTILE


@dataclass(frozen=True)
class Loss(ABC):
    """A function rho of the residual that is near half its square, in units of the scale.

    Attributes:
        scale: Standard deviation s of the residuals [m].
        tuning: From where on residuals are taken for outliers, c, in units of the scale; with these
            a mean of normal residuals has 95 % of the efficiency that squares would give it.
    """

    scale: float
    tuning: ClassVar[float]

    def values(self, residuals: Array) -> Array:
        """Rho of residuals r (N,) [m], without a unit: r^2 / (2 s^2) near zero."""
        return self._values((residuals / self.scale) ** 2)

    def gradient(self, residuals: Array) -> Array:
        """Returns the derivative of rho, (N,) [1/m]."""
        return self.weights(residuals) * residuals

    def weights(self, residuals: Array) -> Array:
        """The derivative over the residual, for Gauss-Newton, (N,) [1/m^2]: 1 / s^2 near zero."""
        return self.inlier_probability(residuals) / self.scale**2

    def inlier_probability(self, residuals: Array) -> Array:
        """The weight of residuals (N,) [m] against that of a small one, (N,), from 0 to 1."""
        return self._relative_weights((residuals / self.scale) ** 2)

    @abstractmethod
    def _values(self, squares: Array) -> Array:
        """Rho of u (N,), for u^2."""

    @abstractmethod
    def _relative_weights(self, squares: Array) -> Array:
        """Psi(u) / u, (N,), for u^2."""


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
    """``u^2 / 2 / (1 + (u/c)^2)``, which comes to c^2 / 2 far away."""

    tuning = 3.787

    def _values(self, squares: Array) -> Array:
        return 0.5 * squares / (1.0 + squares / self.tuning**2)

    def _relative_weights(self, squares: Array) -> Array:
        return 1.0 / (1.0 + squares / self.tuning**2) ** 2


class PseudoHuber(Loss):
    """``sqrt(1 + u^2) - 1``: half the square near zero, a line far away."""

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
"""Half of normal deviates are within so many standard deviations."""
