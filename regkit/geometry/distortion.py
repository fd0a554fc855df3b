"""Lens distortion: where a lens shows what a pinhole camera would see elsewhere.

Both models and the order of their coefficients are those of OpenCV. Directions are x/z and y/z of
points in the camera's frame, before and after the distortion.

- D. C. Brown, Close-range camera calibration, Photogrammetric Engineering 37, 1971; with the
  denominator of OpenCV's rational model.
- J. Kannala and S. Brandt, A generic camera model and calibration method for conventional,
  wide-angle, and fish-eye lenses, PAMI 28, 2006.
"""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any, ClassVar

import numpy as np

from regkit.system.arrays import Array
from regkit.system.errors import DataError
from regkit.system.printable import shortened

SAMPLES = 2048
"""Number of radii at which the distortion is checked to be one to one."""

LARGEST = 1e6
"""Largest coefficient; rational models have large ones that cancel each other."""


@dataclass(frozen=True)
class Distortion(ABC):
    """A lens distortion.

    Attributes:
        coefficients: Its coefficients; those that are left out are zero.
    """

    model: ClassVar[str]
    """Name in files."""
    counts: ClassVar[tuple[int, ...]]
    """Possible numbers of coefficients."""

    coefficients: tuple[float, ...]

    def __post_init__(self) -> None:
        """Raises DataError if the number of the coefficients is wrong, or one is not finite."""
        if len(self.coefficients) not in self.counts:
            raise DataError(
                f"the distortion {self.model} has {' or '.join(map(str, self.counts))} "
                f"coefficients; here are {len(self.coefficients)}"
            )
        for value in self.coefficients:
            if not abs(value) <= LARGEST:
                raise DataError(f"the distortion {self.model} has the coefficient {value}")

    @property
    def is_none(self) -> bool:
        """Whether all coefficients are zero, and nothing is distorted."""
        return not any(self.coefficients)

    def distorted(self, directions: Array) -> Array:
        """Returns the directions (N, 2) in which the lens shows the directions (N, 2).

        Far outside the image a polynomial turns back, and would show the same pixel twice:
        directions beyond are NaN.
        """
        radii = np.hypot(*directions.T)
        samples = np.linspace(0.0, float(radii.max(initial=0.0)), SAMPLES)
        with np.errstate(all="ignore"):
            grows = np.diff(self._radial(samples)) > 0.0
            shown = self._shown(directions)
        if not grows.all() and samples[-1] > 0.0:
            shown[radii > samples[int(np.argmin(grows))]] = np.nan
        return shown

    @abstractmethod
    def _radial(self, radii: Array) -> Array:
        """Returns the radii (N,) at which radii (N,) are shown, without decentring."""

    @abstractmethod
    def _shown(self, directions: Array) -> Array:
        """Returns the distorted directions (N, 2)."""


class BrownConrady(Distortion):
    """Radial and decentring distortion: k1 k2 p1 p2 [k3 [k4 k5 k6]]."""

    model = "brown_conrady"
    counts = (4, 5, 8)

    def _radial(self, radii: Array) -> Array:
        return radii * self._factor(radii**2)

    def _factor(self, square: Array) -> Array:
        k1, k2, _, _, k3, k4, k5, k6 = self._padded()
        above = 1.0 + square * (k1 + square * (k2 + square * k3))
        return np.asarray(above / (1.0 + square * (k4 + square * (k5 + square * k6))))

    def _shown(self, directions: Array) -> Array:
        _, _, p1, p2, *_ = self._padded()
        x, y = directions.T
        square = x**2 + y**2
        factor = self._factor(square)
        return np.column_stack(
            [
                x * factor + 2.0 * p1 * x * y + p2 * (square + 2.0 * x**2),
                y * factor + p1 * (square + 2.0 * y**2) + 2.0 * p2 * x * y,
            ]
        )

    def _padded(self) -> tuple[float, ...]:
        return (*self.coefficients, *[0.0] * (8 - len(self.coefficients)))


class KannalaBrandt(Distortion):
    """Fisheye lens, whose radius is a polynomial of the angle to the axis: k1 k2 k3 k4."""

    model = "kannala_brandt"
    counts = (4,)

    @property
    def is_none(self) -> bool:
        """False: with zeros the radius is the angle, and not its tangent."""
        return False

    def _radial(self, radii: Array) -> Array:
        k1, k2, k3, k4 = self.coefficients
        angle = np.arctan(radii)
        square = angle**2
        return np.asarray(
            angle * (1.0 + square * (k1 + square * (k2 + square * (k3 + square * k4))))
        )

    def _shown(self, directions: Array) -> Array:
        radii = np.hypot(*directions.T)
        # In the limit of radius zero, angle and radius agree.
        factor = np.ones(len(radii))
        np.divide(self._radial(radii), radii, out=factor, where=radii > 0.0)
        return np.asarray(directions * factor[:, None])


MODELS: dict[str, type[Distortion]] = {one.model: one for one in (BrownConrady, KannalaBrandt)}
"""Models by their names in files."""


def distortion_of(content: Any) -> Distortion | None:
    """Returns the distortion in a camera's file, ``{model, coefficients}``; None without any.

    Raises:
        DataError: If it is not of this form, or the model is unknown.
    """
    if content is None:
        return None
    if not isinstance(content, dict) or sorted(content) != ["coefficients", "model"]:
        raise DataError(
            "'distortion' must have model and coefficients, such as {model: brown_conrady, "
            f"coefficients: [0.1, 0, 0, 0, 0]}}; it is {shortened(str(content), 100)}"
        )
    name, values = content["model"], content["coefficients"]
    if not isinstance(name, str) or name not in MODELS:
        raise DataError(
            f"no distortion '{shortened(str(name), 40)}' (there are: {', '.join(MODELS)})"
        )
    return MODELS[name](numbers_of(values))


def numbers_of(values: Any) -> tuple[float, ...]:
    """Returns coefficients as numbers.

    Raises:
        DataError: If they are no list of numbers.
    """
    if not isinstance(values, Sequence) or not all(
        isinstance(value, (int, float)) and not isinstance(value, bool) for value in values
    ):
        raise DataError(f"the coefficients must be numbers: {shortened(str(values), 100)}")
    return tuple(map(float, values))
