"""Primitives: the pieces of a shape model, fixed in the segments of a skeleton.

Three frames are involved: the primitive's own *axes*, along which its scales are measured, the
*segment* that carries it, and the *world*, where a kernel compares it with data.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import Generic, Self, TypeVar

import numpy as np

from regkit.primitives.accumulation import (
    accumulated_residuals,
    accumulated_stiffness,
    accumulated_wrenches,
)
from regkit.system.arrays import Array, Indices
from regkit.system.brief import Brief


@dataclass(frozen=True)
class Primitives(Brief):
    """K primitives in the frames of their segments; a subclass defines the meaning of the scales.

    Attributes:
        segments: Segment of each primitive, (K,).
        centres: Positions in the segments' frames, (K, 3) [m].
        axes: R_segment_primitive, (K, 3, 3).
        scales: Sizes along the primitive's own axes, (K, 3) [m].
        weights: Weights of the primitives, (K,).
    """

    segments: Indices
    centres: Array
    axes: Array
    scales: Array
    weights: Array

    def __len__(self) -> int:
        """Number K of primitives."""
        return len(self.segments)

    def place(self, transforms: Array) -> Placed[Self]:
        """Returns the primitives in the world, for T_world_segment (S, 4, 4)."""
        carriers = transforms[self.segments]
        rotations = carriers[:, :3, :3]
        centres = (rotations @ self.centres[:, :, None])[:, :, 0] + carriers[:, :3, 3]
        return Placed(self, carriers[:, :3, 3], centres, rotations @ self.axes)

    def scaled(self, factor: float) -> Self:
        """Returns the primitives of a skeleton whose lengths are multiplied by ``factor``."""
        return replace(self, centres=factor * self.centres, scales=factor * self.scales)


P_co = TypeVar("P_co", bound=Primitives, covariant=True)


@dataclass(frozen=True)
class Placed(Brief, Generic[P_co]):
    """Primitives in the world.

    Attributes:
        primitives: The primitives in the frames of their segments.
        carriers: Origins of the segments that carry the primitives, (K, 3) [m].
        centres: Positions in the world, (K, 3) [m].
        axes: R_world_primitive, (K, 3, 3).
    """

    primitives: P_co
    carriers: Array
    centres: Array
    axes: Array

    def __len__(self) -> int:
        """Number K of primitives."""
        return len(self.centres)

    def covariances(self) -> Array:
        """Returns ``R diag(scales^2) R^T`` in the world, (K, 3, 3) [m^2]."""
        return (self.axes * self.primitives.scales[:, None, :] ** 2) @ np.swapaxes(self.axes, 1, 2)

    def local(self, points: Array) -> Array:
        """Returns world points (N, 3) in the primitives' axes about their centres, (N, K, 3)."""
        return np.asarray(np.einsum("kji,nkj->nki", self.axes, points[:, None] - self.centres))

    def accumulate(self, wrenches: Array, segments: int) -> Array:
        """Returns wrenches (K, 6) of the primitives summed about the segments' origins, (S, 6)."""
        arms = self.centres - self.carriers
        return accumulated_wrenches(wrenches, arms, self.primitives.segments, segments)

    def accumulate_stiffness(self, stiffness: Array, segments: int) -> Array:
        """Returns blocks (K, 6, 6) of the primitives about the segments' origins, (S, 6, 6)."""
        arms = self.centres - self.carriers
        return accumulated_stiffness(stiffness, arms, self.primitives.segments, segments)

    def accumulate_residuals(
        self, owners: Indices, values: Array, rows: Array, weights: Array, segments: int
    ) -> tuple[Array, Array]:
        """Returns wrenches (S, 6) and blocks (S, 6, 6) of residuals about the segments' origins.

        Args:
            owners: Primitive of each residual, (R,).
            values: Residuals with D components, (R, D).
            rows: Derivatives to the owners' motions about their centres, (R, D, 6).
            weights: Weights of the residuals, (R,).
            segments: Number S of segments.
        """
        wrenches, blocks = accumulated_residuals(owners, values, rows, weights, len(self))
        return (
            self.accumulate(wrenches, segments),
            self.accumulate_stiffness(blocks, segments),
        )
