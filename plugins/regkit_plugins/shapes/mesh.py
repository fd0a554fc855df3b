"""The shape model of the vertices of a skinned mesh."""

from __future__ import annotations

from typing import ClassVar, Literal

import numpy as np
import scipy

from regkit.body import Body
from regkit.interfaces import ShapeModel
from regkit.primitives import Primitives
from regkit.primitives.surfels import Surfels
from regkit.system.arrays import Array
from regkit.system.errors import ConfigError

NEIGHBOURS = 4
"""Number of nearest neighbours whose mean distance is the spacing of a vertex."""


TOGETHER = 6
"""Decimals of a metre to which vertices in the same place agree."""


class Mesh(ShapeModel):
    """The vertices of the template's skinned mesh with their normals, as surfels for ICP.

    Vertices near a joint are skinned to the segments on both sides, by linear blend skinning.
    """

    kind: Literal["mesh"] = "mesh"
    makes: ClassVar[type[Primitives]] = Surfels

    def bind(self, body: Body) -> Surfels:
        """Returns the vertices of the body's surface as surfels.

        Raises:
            ConfigError: If the body has no surface, or a surface without normals.
        """
        if body.surface is None:
            raise ConfigError(
                f"the template '{body.name}' has no mesh; add one to its YAML (mesh: FILE.npz), or "
                "choose a shape model of capsules or Gaussians"
            )
        if body.surface.normals is None:
            raise ConfigError(
                f"shape 'mesh' needs normals, which the surface of '{body.name}' does not have"
            )
        rest = body.place(body.skeleton.rest()).transforms
        return Surfels.of(body.surface, body.surface.normals, _spacings(body.surface.place(rest)))


def _spacings(vertices: Array) -> Array:
    """Returns the mean distance (V,) [m] of each vertex (V, 3) to its nearest neighbours.

    Vertices in the same place, as on sharp edges and seams of a texture, count as one.
    """
    places, owners = np.unique(vertices.round(TOGETHER), axis=0, return_inverse=True)
    distances, _ = scipy.spatial.cKDTree(places).query(places, k=min(NEIGHBOURS + 1, len(places)))
    return np.asarray(np.asarray(distances)[owners.ravel(), 1:].mean(axis=1))
