"""Shape models with one Gaussian per surface point: of a point cloud or a mesh's vertices."""

from __future__ import annotations

from abc import ABC, abstractmethod
from typing import ClassVar, Self

import numpy as np

from regkit.body import Body
from regkit.clouds import normals, spacing
from regkit.config.quantities import Length
from regkit.interfaces import ShapeModel
from regkit.primitives import Gaussians, Primitives
from regkit.system.arrays import Array
from regkit.system.errors import ConfigError


class CloudShape(ShapeModel, ABC):
    """One Gaussian per point of a body's surface, all of the same width."""

    makes: ClassVar[type[Primitives]] = Gaussians

    width: Length | None = None
    """Standard deviation along the surface [m]; by default the spacing of neighbouring points."""

    @abstractmethod
    def flat(self) -> float:
        """Returns the standard deviation along the normal as a fraction of the width."""

    def wide(self, width: float) -> Self:
        """Returns a copy of the shape model with another width [m]."""
        return self.model_copy(update={"width": width})

    def bind(self, body: Body) -> Gaussians:
        """Returns one Gaussian per surface point, on the segment with the largest blend weight.

        Raises:
            ConfigError: If the body has no surface.
        """
        surface = body.surface
        if surface is None:
            raise ConfigError(
                f"shape '{self.kind}' needs a surface, and the template '{body.name}' has none; "
                "take a template with a surface, or another shape"
            )
        segments, points, known = surface.unblended()
        width = spacing(points) if self.width is None else self.width
        flat = self.flat()
        if flat == 1.0:
            axes = np.tile(np.eye(3), (len(points), 1, 1))
        else:
            axes = along(normals(points) if known is None else known)
        scales = np.broadcast_to([width, width, flat * width], points.shape)
        return Gaussians(segments, points, axes, scales, np.ones(len(points)))


def along(directions: Array) -> Array:
    """Returns right-handed axes (N, 3, 3) whose third axis is a given unit vector (N, 3).

    Source: Duff et al., Building an Orthonormal Basis, Revisited, 2017, listing 3.
    """
    x, y, z = directions.T
    sign = np.copysign(1.0, z)
    a = -1.0 / (sign + z)
    b = x * y * a
    first = np.column_stack([1.0 + sign * x * x * a, sign * b, -sign * x])
    second = np.column_stack([b, sign + y * y * a, -y])
    return np.stack([first, second, directions], axis=2)
