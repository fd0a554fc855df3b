"""A skin with a shape in a pose, and the motion of its points with both."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import numpy as np
import scipy

from regkit.body.linear_shape import LinearShape
from regkit.calibration.skin.skin_distances import SkinDistances
from regkit.geometry.surface import SkinnedSurface
from regkit.skeleton import Placement, Pose
from regkit.system.arrays import Array


@dataclass(frozen=True)
class PosedSkin:
    """The skin of a template with a shape, in a pose.

    Attributes:
        shape: The P coefficients' effect.
        surface: The skin with the shape.
        placement: The skeleton with the shape, in the pose.
    """

    shape: LinearShape
    surface: SkinnedSurface
    placement: Placement

    @classmethod
    def of(cls, shape: LinearShape, x: Array, pose: Pose) -> PosedSkin:
        """Returns the skin with the coefficients x (P,) in a pose."""
        return cls(shape, shape.surface(x), Placement.of(shape.skeleton(x), pose))

    @cached_property
    def vertices(self) -> Array:
        """The vertices in the world, (V, 3) [m]."""
        return self.surface.place(self.placement.transforms)

    def rows(self, found: SkinDistances) -> tuple[Array, Array]:
        """Returns the derivatives (R, P) and (R, n) of distances to the shape and to the pose."""
        surface, transforms = self.surface, self.placement.transforms
        segments = surface.segments[found.corners]
        count, carriers = len(found.lengths), segments.shape[2]
        shares = -(found.shares[:, :, None] * surface.blend[found.corners])
        directions = found.directions
        arms = np.einsum(
            "rcaij,rcaj->rcai", transforms[segments, :3, :3], surface.points[found.corners]
        )
        torques = np.cross(arms, directions[:, None, None])
        forces = np.broadcast_to(directions[:, None, None], arms.shape)
        wrenches = np.zeros((count, len(transforms), 6))
        each = np.broadcast_to(np.arange(count)[:, None, None], segments.shape)
        loads = shares[..., None] * np.concatenate([forces, torques], axis=-1)
        np.add.at(wrenches, (each, segments), loads)
        to_pose = wrenches.reshape(count, -1) @ self.placement.jacobian.reshape(
            -1, self.placement.skeleton.dofs
        )
        # In the segments' frames, where the displacements of the vertices are given.
        local = shares[..., None] * np.einsum(
            "rcaji,rj->rcai", transforms[segments, :3, :3], directions
        )
        columns = found.corners[:, :, None] * carriers + np.arange(carriers)
        columns = 3 * columns[..., None] + np.arange(3)
        per_row = np.arange(count + 1) * local[0].size
        moved = scipy.sparse.csr_array(
            (local.ravel(), columns.ravel(), per_row), shape=(count, surface.points.size)
        )
        to_shape = moved @ self.shape.points.reshape(len(self.shape), -1).T
        to_shape += np.einsum("rsi,psi->rp", wrenches[:, :, :3], self._origins)
        return np.asarray(to_shape), np.asarray(to_pose)

    @cached_property
    def _origins(self) -> Array:
        """Derivative of the segments' origins in the world to the coefficients, (P, S, 3)."""
        bones, turns = self.placement.skeleton, self.placement.transforms[:, :3, :3]
        origins = np.zeros_like(self.shape.offsets)
        for segment, parent in enumerate(bones.parents):
            if parent >= 0:
                moved = self.shape.offsets[:, segment] @ turns[parent].T
                origins[:, segment] = origins[:, parent] + moved
        return origins
