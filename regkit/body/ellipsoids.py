"""Parameters of solids by mean and standard deviations, shared by many shape models."""

from __future__ import annotations

from typing import Annotated, Self

import numpy as np
from pydantic import Field

from regkit.body.deformation import Deformation
from regkit.body.freedoms import Freedom
from regkit.body.shape_parameters import ShapeParameters
from regkit.body.vectors import rounded, vector
from regkit.geometry.capsule_moments import capsule_moments
from regkit.geometry.principal_axes import principal_axes
from regkit.geometry.rotation import (
    from_matrix,
    from_vector,
    product,
    rotation_between,
    to_vector,
    vector_to_matrix,
)
from regkit.skeleton.joints import Position, Rotation
from regkit.system.arrays import Array

Deviation = Annotated[float, Field(gt=1e-6, le=1e4)]


class EllipsoidParameters(ShapeParameters):
    """A solid in a segment's frame, such as a Gaussian; a subclass may add parameters."""

    centre: Position
    """Mean [m]."""
    sigma: Deviation | tuple[Deviation, Deviation, Deviation]
    """Standard deviation [m]: one for a sphere, or three along the solid's own axes."""
    rotation_deg: Rotation = (0.0, 0.0, 0.0)
    """Rotation vector of the solid's own axes in the segment's frame [deg]."""

    def deformed(self, deformation: Deformation) -> Self:
        """Returns the solid with its own axes deformed; a sphere stays a sphere."""
        return self.model_copy(
            update={
                "centre": deformation.point(self.centre),
                "sigma": deformation.radius(self.sigma)
                if isinstance(self.sigma, float)
                else deformation.extents(self.sigma, self.rotation_deg),
                "rotation_deg": deformation.rotation(self.rotation_deg),
            }
        )

    def moments(self) -> tuple[Array, Array]:
        """Returns the mean (3,) [m] and ``R diag(sigma^2) R^T`` (3, 3) [m^2]."""
        axes = vector_to_matrix(np.radians(self.rotation_deg)) * np.broadcast_to(self.sigma, 3)
        return np.array(self.centre), axes @ axes.T

    def freedoms(self) -> tuple[Freedom, ...]:
        """Returns centre and size of a sphere; else centre, three sizes and rotation."""
        if isinstance(self.sigma, float):
            return Freedom.POSITION, Freedom.LOG_SCALE
        return Freedom.POSITION, *3 * (Freedom.LOG_SCALE,), Freedom.ROTATION

    def moved(self, step: Array) -> Self:
        """Returns the solid changed by a step (4,) of a sphere, or (9,)."""
        centre = vector(step[:3] + self.centre)
        if isinstance(self.sigma, float):
            return self.model_copy(
                update={"centre": centre, "sigma": self.sigma * float(np.exp(step[3]))}
            )
        rotation = product(from_vector(step[6:]), from_vector(np.radians(self.rotation_deg)))
        return self.model_copy(
            update={
                "centre": centre,
                "sigma": vector(np.exp(step[3:6]) * self.sigma),
                "rotation_deg": vector(np.degrees(to_vector(rotation))),
            }
        )

    @classmethod
    def of_capsule(cls, ends: Array, radii: Array) -> Self:
        """Returns the solid with the moments of a solid capsule.

        The axis next to the capsule's points along it, by the smallest rotation, so that mirror
        images of capsules have mirrored parameters.
        """
        centre, axes, (across, along, _) = capsule_moments(ends, radii)
        nearest = int(np.abs(axes[:, 1]).argmax())
        axis = np.sign(axes[nearest, 1]) * np.eye(3)[nearest]
        sigma = np.where(np.arange(3) == nearest, along, across)
        rotation = to_vector(from_matrix(rotation_between(axis, axes[:, 1])))
        return cls(
            centre=vector(centre), sigma=vector(sigma), rotation_deg=vector(np.degrees(rotation))
        )

    @classmethod
    def fitted(cls, points: Array, like: Self | None = None) -> Self:
        """Returns the solid with the moments of points (N, 3) [m], a sphere if ``like`` is one.

        The axes are ordered and signed for the smallest rotation.
        """
        centre = points.mean(axis=0)
        if like is not None and isinstance(like.sigma, float):
            return like.model_copy(update={"centre": rounded(centre), "sigma": _radius(points)})
        axes, deviations = principal_axes(points)
        found = {
            "centre": rounded(centre),
            "sigma": rounded(deviations),
            "rotation_deg": rounded(np.degrees(to_vector(from_matrix(axes))), 1),
        }
        return cls.model_validate(found) if like is None else like.model_copy(update=found)


class BallParameters(EllipsoidParameters):
    """A solid of the same size in all directions, such as an isotropic Gaussian."""

    sigma: Deviation
    """Standard deviation [m]."""

    @classmethod
    def of_capsule(cls, ends: Array, radii: Array) -> Self:
        """Returns the ball with the mean and total variance of a solid capsule."""
        centre, _, deviations = capsule_moments(ends, radii)
        return cls(centre=vector(centre), sigma=float(np.sqrt(np.mean(deviations**2))))

    @classmethod
    def fitted(cls, points: Array, like: Self | None = None) -> Self:
        """Returns the ball with the mean and total variance of points (N, 3) [m]."""
        found = {"centre": rounded(points.mean(axis=0)), "sigma": _radius(points)}
        return cls.model_validate(found) if like is None else like.model_copy(update=found)


def _radius(points: Array) -> float:
    """Returns the root mean square deviation per axis [m], rounded like ``rounded``."""
    square = ((points - points.mean(axis=0)) ** 2).sum(axis=1).mean() / 3.0
    return round(float(np.sqrt(square)), 4)
