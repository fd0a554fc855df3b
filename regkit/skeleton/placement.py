"""A placed skeleton: forward kinematics, and the chain rule back to the degrees of freedom."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from regkit.arrays import Array
from regkit.rotation import skew, to_matrix, vector_to_matrix
from regkit.skeleton.pose import Pose
from regkit.skeleton.skeleton import Skeleton


@dataclass(frozen=True)
class Placement:
    """Where a pose puts every link, and how the degrees of freedom move them.

    Twists and wrenches are linear first: velocity [m] and rotation [rad], force and torque. Here
    they are taken about the *reference*, the root's origin, which is near enough to the body that
    nothing cancels.

    Attributes:
        skeleton: What is placed.
        pose: How.
        links: T_world_link, (L, 4, 4).
    """

    skeleton: Skeleton
    pose: Pose
    links: Array

    @classmethod
    def of(cls, skeleton: Skeleton, pose: Pose) -> Placement:
        """Where a pose puts every link, eq. 4: T_l = T_par(l) R_l, level by level of the tree."""
        local = skeleton.link_offsets.copy()
        hinges = vector_to_matrix(pose.hinges[:, None] * skeleton.hinge_axes)
        turned = np.concatenate([skeleton.ball_links, skeleton.hinge_links])
        local[turned, :3, :3] = local[turned, :3, :3] @ np.concatenate(
            [to_matrix(pose.balls), hinges]
        )
        links = np.empty_like(local)
        links[0] = pose.root @ local[0]
        for level in skeleton.levels:
            links[level] = links[skeleton.link_parents[level]] @ local[level]
        return cls(skeleton, pose, links)

    @property
    def transforms(self) -> Array:
        """T_world_segment, (S, 4, 4)."""
        return self.links[self.skeleton.segment_links]

    def twists(self) -> Array:
        """The world twist about the reference of each degree of freedom at unit rate, (n, 6)."""
        bones = self.skeleton
        twists = np.zeros((bones.freedoms, 6))
        if bones.free:
            twists[:3, :3] = np.eye(3)
            twists[3:6, 3:] = self.pose.root[:3, :3].T
        balls, hinges = self.links[bones.ball_links], self.links[bones.hinge_links]
        axes = np.concatenate([
            np.swapaxes(balls[:, :3, :3], 1, 2).reshape(-1, 3),
            (hinges[:, :3, :3] @ bones.hinge_axes[:, :, None])[:, :, 0],
        ])  # fmt: skip
        centres = np.concatenate([np.repeat(balls[:, :3, 3], 3, axis=0), hinges[:, :3, 3]])
        twists[bones.ball_freedoms.start :, :3] = np.cross(centres - self._reference, axes)
        twists[bones.ball_freedoms.start :, 3:] = axes
        return twists

    def pull_back(self, wrenches: Array) -> Array:
        """The generalised force (n,) of wrenches (S, 6) about the segments' origins.

        If the wrenches are an energy's derivative to the segments' motion, this is its derivative
        to the steps that ``Skeleton.retract`` takes, at a zero step.
        """
        about_reference = wrenches.copy()
        about_reference[:, 3:] += np.cross(self._arms, wrenches[:, :3])
        # A degree of freedom feels all the segments that it moves: one masked matrix product.
        felt = self.skeleton.moves @ about_reference
        return np.asarray((self.twists() * felt).sum(axis=1))

    def normal_matrix(self, stiffness: Array) -> Array:
        """The Gauss-Newton matrix (n, n) of (S, 6, 6) blocks about the segments' origins."""
        jacobian = self.jacobian()
        loaded = stiffness @ jacobian
        freedoms = self.skeleton.freedoms
        return np.asarray(jacobian.reshape(-1, freedoms).T @ loaded.reshape(-1, freedoms))

    def jacobian(self) -> Array:
        """The twist about its own origin of each segment, by each degree of freedom, (S, 6, n)."""
        twists = self.twists()
        about_reference = twists.T[None] * self.skeleton.moves.T[:, None, :]
        jacobian = about_reference.copy()
        jacobian[:, :3] -= skew(self._arms) @ about_reference[:, 3:]
        return jacobian

    @property
    def _reference(self) -> Array:
        return np.asarray(self.pose.root[:3, 3])

    @property
    def _arms(self) -> Array:
        """From the reference to the segments' origins, (S, 3)."""
        return np.asarray(self.transforms[:, :3, 3] - self._reference)
