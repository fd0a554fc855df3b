"""Modes that explain displacements: by measures that have a name, then by principal components."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np

from regkit.body.modes import Modes
from regkit.system.arrays import Array, Indices

SPREAD = 3.5
"""Bounds of the coefficients, in standard deviations from their mean."""


@dataclass(frozen=True)
class Measure:
    """A measure of bodies that has a name.

    Attributes:
        values: Its values, (N,).
        zero: Value of a body whose coefficient is zero: the template's own, if it has one.
    """

    values: Array
    zero: float

    def coefficients(self) -> Array:
        """Returns the values as coefficients (N,): from ``zero``, in standard deviations."""
        return np.asarray((self.values - self.zero) / self.values.std())


def fitted(
    displacements: Array, labels: tuple[str, ...], measures: Mapping[str, Measure], count: int
) -> Modes:
    """Returns modes and their prior.

    The mode of a measure is the displacement that a regression finds for one standard deviation of
    it. The rest is explained by principal components, whose coefficients have about the standard
    deviation one. They are not centred, since the template is not the mean of the bodies: so the
    coefficients of the template itself are zero, and the mean is that of the bodies.

    Args:
        displacements: Displacements of V vertices, then of S joints, (N, V + S, 3) [m].
        labels: Names of the segments, (S,).
        measures: Measures by name.
        count: Number of principal components.
    """
    rows = displacements.reshape(len(displacements), -1)
    known = np.column_stack([measure.coefficients() for measure in measures.values()])
    columns = np.column_stack([np.ones(len(rows)), known])
    named = np.linalg.lstsq(columns, rows, rcond=None)[0][1:]
    rest = rows - known @ named
    left, values, right = np.linalg.svd(rest, full_matrices=False)
    scores = left[:, :count] * values[:count]
    scale = scores.std(axis=0)
    coefficients = np.column_stack([known, scores / scale])
    modes = np.concatenate([named, scale[:, None] * right[:count]])
    # Single precision keeps 24 bits; eleven are a hundredth of a millimetre, and pack well.
    moved = modes.astype(np.float16).astype(np.float64).reshape(len(modes), -1, 3)
    vertices = moved.shape[1] - len(labels)
    mean, spread = coefficients.mean(axis=0), coefficients.std(axis=0)
    return Modes(
        names=(*measures, *(f"shape_{number}" for number in range(1, count + 1))),
        labels=labels,
        joints=moved[:, vertices:],
        vertices=moved[:, :vertices],
        mean=mean,
        covariance=np.cov(coefficients.T),
        bounds=np.column_stack([mean - SPREAD * spread, mean + SPREAD * spread]),
    )


def height(vertices: Array) -> Array:
    """Returns the extents along y (N,) of vertices (N, V, 3) [m]."""
    return np.asarray(np.ptp(vertices[:, :, 1], axis=1))


def mass(vertices: Array, faces: Indices) -> Array:
    """Returns the masses (N,) [kg] of closed meshes (N, V, 3) with the density of people."""
    corners = vertices[:, faces]
    crossed = np.cross(corners[:, :, 1], corners[:, :, 2])
    return np.asarray(DENSITY * np.einsum("nfi,nfi->n", corners[:, :, 0], crossed) / 6.0)


DENSITY = 985.0
"""Density of a person with air in the lungs [kg/m^3]."""
