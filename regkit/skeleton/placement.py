"""A placed skeleton: forward kinematics, and the chain rule back to the degrees of freedom."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import numpy as np

from regkit.arrays import Array
from regkit.rotation import cross, from_vector, skew, to_matrix
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
        """Where a pose puts every link, eq. 4: T_l = T_par(l) R_l, level by level of the tree.

        The joints of the pose may have leading dimensions, for many poses at once; so have then the
        links and the transforms.
        """
        local = np.tile(skeleton.link_offsets, (*pose.hinges.shape[:-1], 1, 1, 1))
        turns = np.concatenate(
            [pose.balls, from_vector(pose.hinges[..., None] * skeleton.hinge_axes)], axis=-2
        )
        local[..., skeleton.turned_links, :3, :3] @= to_matrix(turns)
        links = np.empty_like(local)
        links[..., 0, :, :] = pose.root @ local[..., 0, :, :]
        for level, parents in zip(skeleton.levels, skeleton.level_parents, strict=True):
            links[..., level, :, :] = links[..., parents, :, :] @ local[..., level, :, :]
        return cls(skeleton, pose, links)

    @property
    def transforms(self) -> Array:
        """T_world_segment, (S, 4, 4)."""
        return self.links[..., self.skeleton.segment_links, :, :]

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
        twists[bones.ball_freedoms.start :, :3] = cross(centres - self._reference, axes)
        twists[bones.ball_freedoms.start :, 3:] = axes
        return twists

    def pull_back(self, wrenches: Array) -> Array:
        """The generalised force (n,) of wrenches (S, 6) about the segments' origins.

        If the wrenches are an energy's derivative to the segments' motion, this is its derivative
        to the steps that ``Skeleton.retract`` takes, at a zero step.
        """
        return np.asarray(wrenches.ravel() @ self.jacobian.reshape(-1, self.skeleton.freedoms))

    def normal_matrix(self, stiffness: Array) -> Array:
        """The Gauss-Newton matrix (n, n) of (S, 6, 6) blocks about the segments' origins."""
        freedoms = self.skeleton.freedoms
        loaded = stiffness @ self.jacobian
        return np.asarray(self.jacobian.reshape(-1, freedoms).T @ loaded.reshape(-1, freedoms))

    @cached_property
    def jacobian(self) -> Array:
        """The twist about its own origin of each segment, by each degree of freedom, (S, 6, n)."""
        twists = self.twists()
        jacobian = twists.T[None] * self.skeleton.moves.T[:, None, :]
        jacobian[:, :3] -= skew(self._arms) @ jacobian[:, 3:]
        return jacobian

    @property
    def _reference(self) -> Array:
        return np.asarray(self.pose.root[:3, 3])

    @property
    def _arms(self) -> Array:
        """From the reference to the segments' origins, (S, 3)."""
        return np.asarray(self.transforms[:, :3, 3] - self._reference)
