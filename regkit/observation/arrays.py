"""The arrays of an observation, as compiled functions take them."""

from __future__ import annotations

from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from regkit.observation.compiled_arrays import centred_points
from regkit.observation.silhouette import Silhouette
from regkit.system.arrays import loop_input
from regkit.system.machine_types import IntegerStack, Matrix, SingleMatrix, SingleVector, Vector

if TYPE_CHECKING:
    from regkit.observation.observation import Observation


class SilhouetteArrays(NamedTuple):
    """A silhouette; see ``free_space_distances`` for the arrays.

    Attributes:
        known: Whether there is one; the arrays are empty if not.
        nearest: Minimum depth of each block, (columns, rows) [m].
        shown: Rows of the nearest blocks with depth, (columns, rows, 2).
        scale: Blocks per unit of normalised image coordinates, (2,).
        offset: Block coordinates of the principal point, (2,).
        half: Radius of a block in normalised image coordinates.
    """

    known: bool
    nearest: Matrix
    shown: IntegerStack
    scale: Vector
    offset: Vector
    half: float

    @classmethod
    def of(cls, silhouette: Silhouette | None) -> SilhouetteArrays:
        """Returns the arrays of a silhouette."""
        if silhouette is None:
            return _NO_SILHOUETTE
        return cls(True, *silhouette.arrays)


_NO_SILHOUETTE = SilhouetteArrays(
    False, np.zeros((0, 0)), np.zeros((0, 0, 2), np.int64), np.zeros(2), np.zeros(2), 0.0
)


class ObservationArrays(NamedTuple):
    """Data whose points have one variance.

    Attributes:
        points: (N, 3) [m].
        centred: Coordinates relative to the centre, (3, N) [m].
        centre: Mean of the points, (3,) [m].
        weights: Weights of the points, (N,), summing to one.
        variance: Variance of every point [m^2].
        camera: Whether a camera at the origin saw them.
        silhouette: What its picture shows.
    """

    points: Matrix
    centred: SingleMatrix
    centre: Vector
    weights: SingleVector
    variance: float
    camera: bool
    silhouette: SilhouetteArrays

    @classmethod
    def of(cls, observation: Observation) -> ObservationArrays | None:
        """Returns the arrays of an observation; None if variances differ or all points coincide."""
        points = loop_input(observation.points)
        weights, variances = loop_input(observation.weights), loop_input(observation.variances)
        centred, shares, centre, alike = centred_points(points, weights, variances)
        # The readable form tells why points that all coincide are no data.
        if not alike or not centred.any():
            return None
        return cls(
            points,
            centred,
            centre,
            shares,
            float(variances[0]),
            observation.camera is not None,
            SilhouetteArrays.of(observation.silhouette),
        )
