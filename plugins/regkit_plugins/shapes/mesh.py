"""A body as the vertices of its skinned mesh."""

from __future__ import annotations

from typing import ClassVar, Literal

import numpy as np
from scipy.spatial import cKDTree

from regkit.body import Body
from regkit.interfaces import ShapeModel
from regkit.primitives import Primitives
from regkit.primitives.surfels import Surfels
from regkit.system.arrays import Array
from regkit.system.errors import ConfigError

NEIGHBOURS = 4
"""The spacing of vertices is the mean distance to so many nearest ones."""


class Mesh(ShapeModel):
    """The vertices of the template's skinned mesh with their normals, as ICP takes them.

    Vertices near a joint follow the segments on both sides of it, by linear blend skinning.
    """

    kind: Literal["mesh"] = "mesh"
    makes: ClassVar[type[Primitives]] = Surfels

    def bind(self, body: Body) -> Surfels:
        """The vertices of the body's surface.

        Raises:
            ConfigError: If it has none, or one without normals.
        """
        if body.surface is None:
            raise ConfigError(
                f"the template '{body.name}' has no mesh; give its YAML one (mesh: FILE.npz), or "
                "take a shape that is made of capsules or Gaussians"
            )
        if body.surface.normals is None:
            raise ConfigError(
                f"shape 'mesh' needs normals, which the surface of '{body.name}' does not have"
            )
        rest = body.place(body.skeleton.rest()).transforms
        return Surfels.of(body.surface, body.surface.normals, _spacings(body.surface.place(rest)))


def _spacings(vertices: Array) -> Array:
    """How far each vertex (V, 3) is from its neighbours, (V,) [m]."""
    distances, _ = cKDTree(vertices).query(vertices, k=min(NEIGHBOURS + 1, len(vertices)))
    return np.asarray(np.asarray(distances)[:, 1:].mean(axis=1))
