"""Linear shape modes of a template, in a file beside it."""

from __future__ import annotations

from collections import Counter
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from regkit.geometry.mesh_file import FARTHEST, SHOWN, Arrays, checked_shape
from regkit.system.archives import read_arrays
from regkit.system.arrays import Array, read_only
from regkit.system.brief import Brief
from regkit.system.errors import DataError
from regkit.system.files import write_arrays
from regkit.system.guard import reading
from regkit.system.printable import is_name, shortened

KEYS = ("names", "labels", "joints", "vertices", "mean", "covariance", "bounds")
"""Names of the arrays in a file of modes, which are the fields of ``Modes``."""

ASYMMETRIC = 1e-4
"""Largest difference between a covariance and its transpose, relative to its largest entry."""


@dataclass(frozen=True)
class Modes(Brief):
    """Linear shape modes of a template: displacements for each unit of a coefficient.

    There are K modes, which displace S segments and the V vertices of the template's skin, in the
    body frame and in the skin's rest pose.

    Attributes:
        names: Names of the modes, such as ``height`` or ``beta_1``, (K,).
        labels: Names of the segments that ``joints`` displaces, (S,).
        joints: Displacements of the segments' origins, (K, S, 3) [m].
        vertices: Displacements of the vertices, (K, V, 3) [m].
        mean: Mean of the coefficients, (K,).
        covariance: Covariance of the coefficients, (K, K).
        bounds: Smallest and largest coefficients, (K, 2).
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
            DataError: If the file is missing or damaged, or one of the arrays is missing or wrong.
        """
        arrays = read_arrays(path, KEYS, f"shape modes, an .npz file with {', '.join(KEYS)}")
        with reading(path, "shape modes"):
            return cls.of(arrays)

    @classmethod
    def of(cls, arrays: Arrays) -> Modes:
        """Returns the modes of the arrays ``KEYS``, which are checked.

        Raises:
            DataError: If one of them is wrong.
        """
        names, labels = _names(arrays, "names"), _names(arrays, "labels")
        count = len(names)
        return cls(
            names,
            labels,
            read_only(checked_shape(arrays, "joints", count, len(labels), 3, most=FARTHEST)),
            read_only(checked_shape(arrays, "vertices", count, None, 3, most=FARTHEST)),
            read_only(checked_shape(arrays, "mean", count, most=FARTHEST)),
            read_only(_covariance(arrays, count)),
            read_only(_bounds(arrays, count)),
        )

    def write(self, path: Path) -> None:
        """Writes an ``.npz`` file that ``read`` accepts.

        Raises:
            DataError: If the file cannot be written.
        """
        arrays = {key: getattr(self, key) for key in KEYS}
        write_arrays(
            path,
            {
                key: np.array(value) if isinstance(value, tuple) else value.astype(np.float32)
                for key, value in arrays.items()
            },
        )


def _names(arrays: Arrays, key: str) -> tuple[str, ...]:
    stored = np.atleast_1d(arrays[key]).ravel()
    if stored.dtype.kind not in "US" or not len(stored):
        raise DataError(f"{key} is of type {stored.dtype} and length {len(stored)}; it needs names")
    names = tuple(stored.astype(np.str_).tolist())
    odd = [name for name in names if not is_name(name)]
    if odd:
        raise DataError(f"{key} has '{shortened(odd[0])}', which cannot be printed")
    twice = sorted(name for name, count in Counter(names).items() if count > 1)
    if twice:
        raise DataError(f"{key} must be unique names; repeated: {', '.join(twice[:SHOWN])}")
    return names


def _covariance(arrays: Arrays, count: int) -> Array:
    covariance = checked_shape(arrays, "covariance", count, count, most=FARTHEST)
    if np.abs(covariance - covariance.T).max() > ASYMMETRIC * np.abs(covariance).max():
        raise DataError("covariance is not symmetric")
    least = float(np.linalg.eigvalsh(covariance).min())
    if least <= 0.0:
        raise DataError(f"covariance has the eigenvalue {least:.3g}; all must be positive")
    return covariance


def _bounds(arrays: Arrays, count: int) -> Array:
    bounds = checked_shape(arrays, "bounds", count, 2, most=FARTHEST)
    wrong = bounds[:, 0] > bounds[:, 1]
    if wrong.any():
        mode = int(np.argmax(wrong))
        raise DataError(f"bounds of mode {mode} are reversed: {bounds[mode].tolist()}")
    return bounds
