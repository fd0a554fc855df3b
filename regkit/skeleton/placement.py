"""Forward kinematics of a pose, and the chain rule to the degrees of freedom."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from math import prod

import numpy as np

from regkit.geometry.rotation import cross
from regkit.skeleton.compiled_placement import joint_twists, place_links, segment_jacobian
from regkit.skeleton.pose import Pose
from regkit.skeleton.skeleton import Skeleton
from regkit.system.arrays import Array, Indices
from regkit.system.brief import Brief


@dataclass(frozen=True)
class Placement(Brief):
    """The world transforms of all links in a pose, and their Jacobian.

    Twists and wrenches are linear first: velocity [m] then rotation [rad], force then torque. They
    refer to the *reference*, the root's origin, which is close to the body and so avoids
    cancellation.

    Attributes:
        skeleton: The skeleton.
        pose: Its pose.
        links: T_world_link, (L, 4, 4).
    """

    skeleton: Skeleton
    pose: Pose
    links: Array

    @classmethod
    def of(cls, skeleton: Skeleton, pose: Pose) -> Placement:
        """Computes forward kinematics, eq. 4: T_l = T_par(l) R_l.

        Balls and hinges of the pose may have leading dimensions for many poses at once; ``links``
        and ``transforms`` then have the same.
        """
        many = pose.hinges.shape[:-1]
        count = prod(many)
        links = place_links(
            skeleton.link_offsets,
            skeleton.link_parents,
            pose.root,
            skeleton.ball_links,
            pose.balls.reshape(count, *pose.balls.shape[-2:]),
            skeleton.hinge_links,
            skeleton.hinge_twists,
            pose.hinges.reshape(count, pose.hinges.shape[-1]),
        )
        links = links.reshape(*many, *links.shape[1:])
        return cls(skeleton, pose, links)

    @property
    def transforms(self) -> Array:
        """T_world_segment, (S, 4, 4)."""
        return self.links[..., self.skeleton.segment_links, :, :]

    def twists(self) -> Array:
        """Returns the world twist (n, 6) about the reference of each dof at unit rate."""
        bones = self.skeleton
        return joint_twists(
            self.links,
            bones.ball_dofs.start,
            bones.ball_links,
            bones.hinge_links,
            bones.hinge_twists,
            bones.dofs,
            self.pose.root,
        )

    def jacobian_transpose(self, wrenches: Array) -> Array:
        """Returns the generalised force (n,) of wrenches (S, 6) about the segments' origins.

        For wrenches that are the derivative of an energy to the segments' twists, this is its
        gradient to the step of ``Skeleton.retract`` at zero.
        """
        return np.asarray(wrenches.ravel() @ self.jacobian.reshape(-1, self.skeleton.dofs))

    def normal_matrix(self, stiffness: Array) -> Array:
        """Returns the Gauss-Newton matrix (n, n) of blocks (S, 6, 6) about the segment origins."""
        dofs = self.skeleton.dofs
        loaded = stiffness @ self.jacobian
        return np.asarray(self.jacobian.reshape(-1, dofs).T @ loaded.reshape(-1, dofs))

    def rows(self, segments: Indices, points: Array, directions: Array) -> Array:
        """Returns the Jacobian (R, n) of point displacements along directions.

        Args:
            segments: Index of the segment of each point, (R,).
            points: Points in the world, (R, 3) [m].
            directions: Directions in the world, (R, 3).
        """
        arms = points - self.transforms[segments, :3, 3]
        wrenches = np.concatenate([directions, cross(arms, directions)], axis=1)
        return np.asarray((wrenches[:, None, :] @ self.jacobian[segments])[:, 0])

    @cached_property
    def jacobian(self) -> Array:
        """Twist of each segment about its own origin per degree of freedom, (S, 6, n)."""
        return segment_jacobian(self.twists(), self.skeleton.dof_mask, self._arms)

    @property
    def _reference(self) -> Array:
        return np.asarray(self.pose.root[:3, 3])

    @property
    def _arms(self) -> Array:
        """Vectors from the reference to the segments' origins, (S, 3) [m]."""
        return np.asarray(self.transforms[:, :3, 3] - self._reference)
