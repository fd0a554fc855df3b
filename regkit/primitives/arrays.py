"""The arrays of primitives, as compiled functions take them."""

from __future__ import annotations

from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from regkit.system.machine_types import IntegerVector, Matrix, Stack, Vector

if TYPE_CHECKING:
    from regkit.primitives.primitives import Primitives


class PrimitiveArrays(NamedTuple):
    """Primitives in the frames of their segments; see ``Primitives``.

    Attributes:
        segments: Segment of each primitive, (K,).
        centres: Positions in the segments' frames, (K, 3) [m].
        axes: R_segment_primitive, (K, 3, 3).
        scales: Sizes along the primitive's own axes, (K, 3) [m].
        weights: Weights of the primitives, (K,).
    """

    segments: IntegerVector
    centres: Matrix
    axes: Stack
    scales: Matrix
    weights: Vector

    @classmethod
    def of(cls, primitives: Primitives) -> PrimitiveArrays:
        """Returns the arrays of primitives."""
        return cls(
            np.array(primitives.segments, dtype=np.int64, order="C"),
            np.array(primitives.centres, order="C"),
            np.array(primitives.axes, order="C"),
            np.array(primitives.scales, order="C"),
            np.array(primitives.weights, order="C"),
        )
