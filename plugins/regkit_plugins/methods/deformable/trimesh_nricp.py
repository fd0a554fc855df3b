"""Non-rigid iterative closest points by trimesh."""

from __future__ import annotations

from typing import Annotated, Any, Literal

import numpy as np
import scipy
from pydantic import Field

from regkit.clouds import normals
from regkit.deformation import Displaced, InterpolatedDisplacements, LibraryDeformation
from regkit.system.arrays import Array
from regkit.system.optional import load_library

NEIGHBOURS = 6
"""Number of neighbours with which a point is stiffly connected, as in a mesh of triangles."""


class TrimeshNRICP(LibraryDeformation):
    """Non-rigid iterative closest points by trimesh.

    The method is that of Amberg et al. (2007). The library wants a mesh as source, for the edges
    along which it is stiff: here each point makes triangles with its nearest neighbours. The target
    is a cloud. Other points move by an interpolation.
    """

    kind: Literal["trimesh_nricp"] = "trimesh_nricp"

    max_distance: Annotated[float, Field(gt=0.0, le=1e3)] = 0.1
    """Distance beyond which pairs do not count, relative to the diagonal of the body's box; the
    default is the library's."""

    def library(self) -> Any:
        """Returns the module ``trimesh``."""
        return load_library("trimesh")

    def displaced(self, source: Array, target: Array) -> Displaced:
        """Registers with ``nricp_amberg``, with the library's stiffnesses."""
        trimesh = self.library()
        places = np.unique(source, axis=0)
        near = np.asarray(scipy.spatial.KDTree(places).query(places, NEIGHBOURS + 1)[1])
        faces = np.concatenate([near[:, [0, i, i + 1]] for i in range(1, NEIGHBOURS, 2)])
        mesh = trimesh.Trimesh(
            places, faces, vertex_normals=normals(places), process=False, validate=False
        )
        moved = trimesh.registration.nricp_amberg(
            mesh,
            target,
            distance_threshold=self.max_distance,
            use_faces=False,
            use_vertex_normals=False,
        )
        moving = InterpolatedDisplacements(places, np.asarray(moved) - places)
        return Displaced(moving, True, 0, "the library does not report convergence")
