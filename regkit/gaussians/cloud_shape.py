"""A body's surface points as Gaussians: those of a cloud, or the vertices of a mesh."""

from __future__ import annotations

from abc import ABC, abstractmethod
from typing import Annotated, ClassVar, Self

import numpy as np
from pydantic import Field

from regkit.body import Body
from regkit.clouds import normals, spacing
from regkit.interfaces import ShapeModel
from regkit.primitives import Gaussians, Primitives
from regkit.system.arrays import Array
from regkit.system.errors import ConfigError

Length = Annotated[float, Field(gt=0.0)]


class CloudShape(ShapeModel, ABC):
    """A Gaussian at each point of a body's surface, all of the same width."""

    makes: ClassVar[type[Primitives]] = Gaussians

    width: Length | None = None
    """Standard deviation in the surface [m]; the distance of neighbouring points without it."""

    @abstractmethod
    def flat(self) -> float:
        """Returns the standard deviation along the normal, as a part of the width."""

    def wide(self, width: float) -> Self:
        """Returns the same shape model with another width [m]."""
        return self.model_copy(update={"width": width})

    def bind(self, body: Body) -> Gaussians:
        """One Gaussian for each point of the surface, on the segment that carries most of it.

        Raises:
            ConfigError: If the body has no surface.
        """
        surface = body.surface
        if surface is None:
            raise ConfigError(
                f"shape '{self.kind}' makes Gaussians of a surface's points, and the template "
                f"'{body.name}' has none; take a template of kind cloud, or the shape gsog"
            )
        carrier = surface.blend.argmax(axis=1)
        vertices = np.arange(len(surface))
        points = surface.points[vertices, carrier]
        width = spacing(points) if self.width is None else self.width
        flat = self.flat()
        known = None if surface.normals is None else surface.normals[vertices, carrier]
        if flat == 1.0:
            axes = np.tile(np.eye(3), (len(points), 1, 1))
        else:
            axes = along(normals(points) if known is None else known)
        scales = np.tile([width, width, flat * width], (len(points), 1))
        return Gaussians(
            surface.segments[vertices, carrier], points, axes, scales, np.ones(len(points))
        )


def along(directions: Array) -> Array:
    """Right-handed axes (N, 3, 3) whose third one is a unit vector (N, 3).

    Source: Duff et al., Building an Orthonormal Basis, Revisited, 2017, listing 3.
    """
    x, y, z = directions.T
    sign = np.copysign(1.0, z)
    a = -1.0 / (sign + z)
    b = x * y * a
    first = np.column_stack([1.0 + sign * x * x * a, sign * b, -sign * x])
    second = np.column_stack([b, sign + y * y * a, -y])
    return np.stack([first, second, directions], axis=2)
