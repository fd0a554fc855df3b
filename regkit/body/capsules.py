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

SLIMMEST = 0.1
"""Least radius of an end of a fitted capsule, as a fraction of its mean radius."""

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
    def fitted(cls, points: Array, like: Self | None = None) -> Self:
        """Returns the capsule that fills points (N, 3) [m], of one radius if ``like`` has one.

        Its axis is the first principal axis. Each half of it gives the radius of a disc with the
        same mean square distance from the axis; the radii of the ends continue those of the halves.
        Without ``like``, the capsule starts at the end next to the segment's joint.
        """
        centre = points.mean(axis=0)
        axes, deviations = principal_axes(points)
        axis = axes[:, deviations.argmax()]
        onward = centre if like is None else np.subtract(like.end, like.start)
        axis = -axis if axis @ onward < 0.0 else axis
        heights = (points - centre) @ axis
        squares = ((points - centre) ** 2).sum(axis=1) - heights**2
        radius = float(np.sqrt(2.0 * squares.mean()))
        uniform = like is not None and isinstance(like.radius, float)
        radii = np.full(2, radius) if uniform else _end_radii(heights, squares, radius)
        reach = np.array([heights.min() + radii[0], heights.max() - radii[1]])
        # A solid that is wider than long is a sphere.
        reach = reach if reach[0] < reach[1] else np.full(2, reach.mean())
        found = {
            "start": rounded(centre + reach[0] * axis),
            "end": rounded(centre + reach[1] * axis),
            "radius": _rounded(radius) if uniform else (_rounded(radii[0]), _rounded(radii[1])),
        }
        return cls.model_validate(found) if like is None else like.model_copy(update=found)


def _end_radii(heights: Array, squares: Array, radius: float) -> Array:
    """Returns the radii (2,) [m] of a capsule's ends.

    Args:
        heights: Positions of the points along the axis from their mean, (N,) [m].
        squares: Their squared distances from the axis, (N,) [m^2].
        radius: Mean radius [m].
    """
    upper = heights > 0.0
    halves = [~upper, upper]
    middles = np.array([heights[half].mean() for half in halves])
    discs = np.sqrt([2.0 * squares[half].mean() for half in halves])
    slope = (discs[1] - discs[0]) / (middles[1] - middles[0])
    # The slope of a cone's radius is less than one, else one sphere contains the other.
    slope = np.clip(slope, -0.9, 0.9)
    ends = np.array([heights.min() + radius, heights.max() - radius])
    return np.asarray(np.maximum(radius + slope * ends, SLIMMEST * radius))


def _rounded(length: float) -> float:
    return round(float(length), 4)
