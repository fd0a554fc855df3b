"""A scan or a frame with the shape of its body: the template's skin, shaped and posed."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np
import scipy

from regkit.body import BodyDescription
from regkit.body.linear_shape import LinearShape
from regkit.body.shaped import shaped
from regkit.calibration.skin import Measured, fitted, measured
from regkit.calibration.skin.posed_skin import PosedSkin
from regkit.calibration.subject_shape import ModeShape, check_distance
from regkit.geometry.mesh_distance import mesh_distances
from regkit.geometry.skinned_mesh import SkinnedMesh
from regkit.interfaces import Solver
from regkit.observation import Observation
from regkit.skeleton import Pose
from regkit.system.arrays import Array, Indices

REACH = 3.0
"""A point belongs to the body if a preprocessed point is within this many of their spacings."""


@dataclass(frozen=True)
class ScanFit:
    """A body's shape and pose in one frame.

    Attributes:
        shape: The template's shape as a function of coefficients.
        x: The coefficients, (P,).
        pose: The pose.
        vertices: The skin's vertices in the frame of the data, (V, 3) [m], in the template's order.
        to_skin: Distances of the data to the skin, (N,) [m].
        to_data: Distances of the skin's vertices to the data, (V,) [m].
    """

    shape: LinearShape
    x: Array
    pose: Pose
    vertices: Array
    to_skin: Array
    to_data: Array

    @classmethod
    def of(
        cls,
        template: BodyDescription,
        size: float,
        pose: Pose,
        observation: Observation,
        points: Array,
        solver: Solver,
    ) -> ScanFit:
        """Returns the most probable shape and pose.

        Args:
            template: A template with shape modes.
            size: Size of the body that was registered [m].
            pose: Its pose.
            observation: The preprocessed data that it was registered to.
            points: The data of the frame before that, of which those near the preprocessed ones
                count, (N, 3) [m].
            solver: Solver of the fit.

        Raises:
            NotFoundError: If the shape is implausible, or the skin is far from the data.
            RegkitError: If the template has no modes, or they are damaged.
        """
        variable = ModeShape(template)
        shape, data = variable.shape, Measured.of(observation)
        if data.camera is None:
            data = replace(data, points=_own(points, observation.points))
        seen = measured(observation) if observation.views else data
        found = fitted(shape, shape.at_size(size), [seen], [pose], solver)
        x, pose = found.coefficients, found.poses[0]
        variable.check(x)
        vertices = PosedSkin.of(shape, x, pose).vertices
        to_skin = mesh_distances(data.chosen, vertices, shape.mesh.faces)
        check_distance(float(np.median(to_skin)), shape.size(x))
        return cls(
            shape=shape,
            x=x,
            pose=pose,
            vertices=vertices,
            to_skin=to_skin,
            to_data=np.asarray(data.tree.query(vertices)[0]),
        )

    @property
    def size(self) -> float:
        """The body's size [m]."""
        return self.shape.size(self.x)

    @property
    def faces(self) -> Indices:
        """Vertex indices of the skin's triangles, (F, 3)."""
        return self.shape.mesh.faces

    def description(self) -> BodyDescription:
        """Returns the template with the shape."""
        return shaped(self.shape, self.x)

    def skin(self) -> SkinnedMesh:
        """Returns the skin with the shape, in its rest pose."""
        return self.shape.skin(self.x)

    def coefficients(self) -> dict[str, float]:
        """Returns the coefficients of the modes by name."""
        return dict(zip(self.shape.names[: self.shape.modes], self.x.tolist(), strict=False))


def _own(points: Array, kept: Array) -> Array:
    """Returns the points (M, 3) that are near those that the preprocessing kept."""
    tree = scipy.spatial.cKDTree(kept)
    spacing = float(np.median(np.asarray(tree.query(kept, k=2)[0])[:, 1]))
    near = np.asarray(tree.query(points)[0]) < REACH * spacing
    return np.asarray(points[near])
