"""Primitives that a template lists for a shape model, on the segments of a body."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Generic, TypeVar

import numpy as np

from regkit.body.capsules import CapsuleParameters
from regkit.body.ellipsoids import EllipsoidParameters
from regkit.body.gaussians import GaussianParameters
from regkit.body.shape_parameters import ShapeParameters
from regkit.geometry.capsules import Capsules
from regkit.geometry.rotation import vector_to_matrix
from regkit.system.arrays import Array, Indices, read_only

P = TypeVar("P", bound=ShapeParameters)
P_co = TypeVar("P_co", bound=ShapeParameters, covariant=True)


@dataclass(frozen=True)
class ListedShape(Generic[P_co]):
    """K primitives in the frames of their segments, at the body's size.

    Attributes:
        segments: Segment of each primitive, (K,).
        parameters: Parameters of the primitives, (K,).
    """

    segments: Indices
    parameters: tuple[P_co, ...]

    def __len__(self) -> int:
        """Number K of primitives."""
        return len(self.parameters)


def of_capsules(capsules: Capsules, made: type[P]) -> ListedShape[P]:
    """Returns one primitive of a class of parameters for each capsule (K)."""
    each = zip(capsules.ends, capsules.radii, strict=True)
    return ListedShape(capsules.segments, tuple(made.of_capsule(*one) for one in each))


def ellipsoids(
    listed: ListedShape[EllipsoidParameters],
) -> tuple[Indices, Array, Array, Array, Array]:
    """Returns the arrays of K solids: segments, centres, axes, scales and weights.

    Returns:
        Segments (K,), centres (K, 3) [m], R_segment_primitive (K, 3, 3), standard deviations
        (K, 3) [m], and unit weights (K,).
    """
    solids = listed.parameters
    return (
        listed.segments,
        read_only([one.centre for one in solids]).reshape(-1, 3),
        vector_to_matrix(np.radians([one.rotation_deg for one in solids]).reshape(-1, 3)),
        read_only([np.broadcast_to(one.sigma, 3) for one in solids]).reshape(-1, 3),
        np.ones(len(solids)),
    )


def gaussians(
    listed: ListedShape[GaussianParameters],
) -> tuple[Indices, Array, Array, Array, Array]:
    """Returns the arrays of K Gaussians, like ``ellipsoids``, with their own weights (K,)."""
    weights = np.array([one.weight for one in listed.parameters])
    return *ellipsoids(listed)[:4], weights


def capsules(listed: ListedShape[CapsuleParameters]) -> Capsules:
    """Returns listed capsules in the frames of their segments."""
    return Capsules(
        listed.segments,
        read_only([[one.start, one.end] for one in listed.parameters]).reshape(-1, 2, 3),
        read_only([np.broadcast_to(one.radius, 2) for one in listed.parameters]).reshape(-1, 2),
    )
