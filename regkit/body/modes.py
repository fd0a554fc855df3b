"""Linear shape modes of a template: how its skin and its joints move with a few coefficients."""

from __future__ import annotations

from collections import Counter
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np

from regkit.geometry.mesh_file import FARTHEST, checked_shape
from regkit.system.archives import read_arrays
from regkit.system.arrays import Array
from regkit.system.brief import Brief
from regkit.system.errors import DataError
from regkit.system.files import write_arrays
from regkit.system.guard import reading
from regkit.system.printable import is_name, shortened

KEYS = ("names", "labels", "joints", "vertices", "mean", "covariance", "bounds")
"""Names of the arrays in a file of modes, in the order of the fields of ``Modes``."""

WHAT = f"shape modes, an .npz file with {', '.join(KEYS)}"

SYMMETRIC = 1e-4
"""Largest asymmetry of a covariance, relative to its largest entry."""


@dataclass(frozen=True)
class Modes(Brief):
    """Displacements of a template's skin and joints for each unit of K coefficients.

    They hold in the rest pose of the skin and at the template's own size, and have the vertices of
    its skin. The coefficients have a Gaussian prior.

    Attributes:
        names: Names of the modes, (K,).
        labels: Names of the S segments whose joints move, (S,).
        joints: Displacement of each segment's origin in the body frame, (K, S, 3) [m].
        vertices: Displacement of each vertex in the body frame, (K, V, 3) [m].
        mean: Mean of the coefficients, (K,).
        covariance: Covariance of the coefficients, (K, K).
        bounds: Smallest and largest value of each coefficient, (K, 2).
    """

    names: tuple[str, ...]
    labels: tuple[str, ...]
    joints: Array
    vertices: Array
    mean: Array
    covariance: Array
    bounds: Array

    @classmethod
    def read(cls, path: Path) -> Modes:
        """Reads an ``.npz`` file with the arrays ``KEYS``.

        Raises:
            DataError: If the file is missing or damaged, or an array is missing or wrong.
        """
        arrays = read_arrays(path, KEYS, WHAT)
        with reading(path, WHAT):
            names, labels = (_names(arrays[key], key) for key in ("names", "labels"))
            count = len(names)
            modes = cls(
                names=names,
                labels=labels,
                joints=checked_shape(arrays, "joints", count, len(labels), 3, most=FARTHEST),
                vertices=checked_shape(arrays, "vertices", count, None, 3, most=FARTHEST),
                mean=checked_shape(arrays, "mean", count),
                covariance=checked_shape(arrays, "covariance", count, count),
                bounds=checked_shape(arrays, "bounds", count, 2),
            )
            modes.check()
        return modes

    def check(self) -> None:
        """Checks that the prior is one.

        Raises:
            DataError: If the covariance is not symmetric and positive definite, or the bounds do
                not hold the mean.
        """
        largest = float(np.abs(self.covariance).max(initial=1e-12))
        if float(np.abs(self.covariance - self.covariance.T).max(initial=0.0)) > (
            SYMMETRIC * largest
        ):
            raise DataError("covariance is not symmetric, so it is the covariance of nothing")
        if len(self.names) and float(np.linalg.eigvalsh(self.covariance)[0]) <= 0.0:
            raise DataError("covariance is not positive definite, so it is no prior")
        outside = (self.mean < self.bounds[:, 0]) | (self.mean > self.bounds[:, 1])
        if outside.any():
            mode = int(np.argmax(outside))
            low, high = self.bounds[mode]
            raise DataError(
                f"the mean of '{self.names[mode]}', {self.mean[mode]:g}, is outside its bounds, "
                f"{low:g} to {high:g}"
            )

    def write(self, path: Path) -> None:
        """Writes an ``.npz`` file with the arrays ``KEYS``, in single precision."""
        values = (
            np.array(self.names),
            np.array(self.labels),
            *(
                array.astype(np.float32)
                for array in (self.joints, self.vertices, self.mean, self.covariance, self.bounds)
            ),
        )
        write_arrays(path, dict(zip(KEYS, values, strict=True)))


def _names(array: np.ndarray[Any, Any], key: str) -> tuple[str, ...]:
    """Returns an array of different names.

    Raises:
        DataError: If it is none.
    """
    if array.ndim != 1 or array.dtype.kind != "U":
        raise DataError(f"{key} has the type {array.dtype}; it needs a list of names")
    names = tuple(array.tolist())
    for name in names:
        if not is_name(name):
            raise DataError(f"{key} has {shortened(repr(name))}, which is no name")
    twice = [name for name, count in Counter(names).items() if count > 1]
    if twice:
        raise DataError(f"{key} has '{twice[0]}' more than once")
    return names
