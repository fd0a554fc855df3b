"""Parameters of tapered capsules that a template lists for a shape model."""

from __future__ import annotations

from typing import Self, TypeVar

import numpy as np

from regkit.body.deformation import Deformation
from regkit.body.freedoms import Freedom
from regkit.body.shape_parameters import ShapeParameters
from regkit.body.vectors import rounded, vector
from regkit.geometry.capsule_moments import capsule_moments
from regkit.geometry.principal_axes import principal_axes
from regkit.skeleton.description import CapsuleDescription
from regkit.system.arrays import Array

SLIMMEST = 0.5
"""Least radius of an end of a fitted capsule, as a fraction of the mean of both: limbs
bulge at joints, and are no sharp cones."""

ENDS = (0.15, 0.85)
"""Shares of the points below and above which they are in the ends of a capsule."""

ROUNDS = 20
"""Number of rounds in which a fitted capsule's length and radius follow from its moments."""

SPREADING = 0.27
"""About how much the standard deviation along a capsule grows with its length: 0.25 of a sphere,
0.29 of a line."""

C = TypeVar("C", bound=CapsuleDescription)


def deformed_capsule(capsule: C, deformation: Deformation) -> C:
    """Returns a capsule in a scaled, stretched or mirrored segment."""
    radius = capsule.radius
    return capsule.model_copy(
        update={
            "start": deformation.point(capsule.start),
            "end": deformation.point(capsule.end),
            "radius": deformation.radius(radius)
            if isinstance(radius, float)
            else (deformation.radius(radius[0]), deformation.radius(radius[1])),
        }
    )


class CapsuleParameters(CapsuleDescription, ShapeParameters):
    """A tapered capsule in a segment's frame, with the fields of a segment's ``capsules``."""

    def deformed(self, deformation: Deformation) -> Self:
        """Returns the capsule with its ends and radii deformed."""
        return deformed_capsule(self, deformation)

    def moments(self) -> tuple[Array, Array]:
        """Returns mean (3,) [m] and covariance (3, 3) [m^2] of the solid capsule."""
        ends = np.array([self.start, self.end])
        centre, axes, deviations = capsule_moments(ends, np.broadcast_to(self.radius, 2))
        return centre, axes * deviations**2 @ axes.T

    def freedoms(self) -> tuple[Freedom, ...]:
        """Returns both ends, and the one radius or both."""
        radii = 1 if isinstance(self.radius, float) else 2
        return *2 * (Freedom.POSITION,), *radii * (Freedom.LOG_SCALE,)

    def moved(self, step: Array) -> Self:
        """Returns the capsule changed by a step (7,) with one radius, or (8,)."""
        factors = np.exp(step[6:]).tolist()
        radius = self.radius
        return self.model_copy(
            update={
                "start": vector(step[:3] + self.start),
                "end": vector(step[3:6] + self.end),
                "radius": radius * factors[0]
                if isinstance(radius, float)
                else (radius[0] * factors[0], radius[1] * factors[1]),
            }
        )

    @classmethod
    def of_capsule(cls, ends: Array, radii: Array) -> Self:
        """Returns the capsule itself, with one radius if both are equal."""
        first, second = radii.tolist()
        radius = first if first == second else (first, second)
        return cls(start=vector(ends[0]), end=vector(ends[1]), radius=radius)

    @classmethod
    def fitted(cls, points: Array, like: Self | None = None) -> Self:
        """Returns the capsule with the mean and about the variances of points (N, 3) [m].

        Its axis is the first principal axis. The radius of one end exceeds the other's as the
        halves of the points differ in their distances from the axis, unless ``like`` has one
        radius. Without ``like``, the capsule starts at the end next to the segment's joint.
        """
        centre = points.mean(axis=0)
        axes, deviations = principal_axes(points)
        axis = axes[:, deviations.argmax()]
        onward = centre if like is None else np.subtract(like.end, like.start)
        axis = -axis if axis @ onward < 0.0 else axis
        heights = (points - centre) @ axis
        squares = ((points - centre) ** 2).sum(axis=1) - heights**2
        slope = 0.0 if _is_uniform(like) else _slope(heights, squares)
        spreads = float(heights.std()), float(np.sqrt(0.5 * squares.mean()))
        ends, radii = _filling(*spreads, slope)
        found = {
            "start": rounded(centre + ends[0] * axis),
            "end": rounded(centre + ends[1] * axis),
            "radius": radii[0] if _is_uniform(like) else (radii[0], radii[1]),
        }
        return cls.model_validate(found) if like is None else like.model_copy(update=found)


def _is_uniform(like: CapsuleParameters | None) -> bool:
    return like is not None and isinstance(like.radius, float)


def _filling(along: float, across: float, slope: float) -> tuple[Array, tuple[float, float]]:
    """Returns the ends of a capsule on its axis (2,) and their radii [m], about its mean.

    Args:
        along: Standard deviation along the axis [m].
        across: Standard deviation across it [m].
        slope: Change of the radius per length.
    """
    length, radius = 0.0, 2.0 * across
    ends, radii = np.zeros((2, 3)), np.full(2, radius)
    for _ in range(ROUNDS):
        ends[:, 1] = -0.5 * length, 0.5 * length
        widening = np.clip(0.5 * slope * length / radius, SLIMMEST - 1.0, 1.0 - SLIMMEST)
        radii = radius * np.array([1.0 - widening, 1.0 + widening])
        mean, _, (wide, long, _) = capsule_moments(ends, radii)
        ends -= mean
        radius *= across / wide
        length = max(length + (along - long) / SPREADING, 0.0)
    first, second = (round(float(one), 4) for one in radii)
    return ends[:, 1], (first, second)


def _slope(heights: Array, squares: Array) -> float:
    """Returns the change of the radius along the axis, from those of discs like the two halves.

    Args:
        heights: Positions of the points along the axis from their mean, (N,) [m].
        squares: Their squared distances from the axis, (N,) [m^2].
    """
    # The round ends are narrower than the capsule.
    first, last = np.quantile(heights, ENDS)
    middle = np.median(heights)
    halves = ((first < heights) & (heights <= middle), (middle < heights) & (heights < last))
    if not all(half.any() for half in halves):
        return 0.0  # So few points show no cone.
    low, high = (heights[half].mean() for half in halves)
    narrow, wide = (np.sqrt(2.0 * squares[half].mean()) for half in halves)
    return float((wide - narrow) / (high - low))
