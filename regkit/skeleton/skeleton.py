"""Skeletons: a tree of segments, its degrees of freedom, and steps on its poses."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from regkit.config.model import did_you_mean
from regkit.geometry.rigid import rigid
from regkit.geometry.rotation import (
    conjugate,
    from_matrix,
    product,
    to_vector,
    vector_to_matrix,
)
from regkit.skeleton.compiled_steps import moved_root, turned_balls
from regkit.skeleton.limits import Limits
from regkit.skeleton.pose import Pose, PoseDescription
from regkit.system.arrays import Array, Indices
from regkit.system.errors import ConfigError


@dataclass(frozen=True, eq=False)
class Skeleton:
    """A tree of *links*, each with at most one joint; ``regkit.skeleton.compile`` makes it.

    A universal joint is two hinges, the first of them on a link of its own. So every link's joint
    is free (the root's), a ball, a hinge, or fixed, and a segment is the last link of its joint.

    The degrees of freedom are ordered: the root's translation (3) and rotation (3) if it is free,
    three for each ball joint, one for each hinge.

    Attributes:
        names: Names of the segments, parents first, (S).
        parents: Index of each segment's parent, -1 for the root, (S,).
        free: Whether the root moves.
        segment_links: The link of each segment, (S,).
        link_parents: Index of each link's parent, -1 for the root, (L,).
        link_offsets: T_parent_joint of each link at rest, (L, 4, 4).
        levels: Indices of the links at each depth of the tree below the root.
        ball_links: The link of each ball joint, (n_ball,).
        hinge_links: The link of each hinge, (n_hinge,).
        hinge_axes: Unit axis of each hinge in its link's frame, (n_hinge, 3).
        joint_dofs: The degrees of freedom of each segment's own joint, by the segment's name.
        moves: 1 where a degree of freedom moves a segment, else 0, (n, S).
        limits: Joint limits.
    """

    names: tuple[str, ...]
    parents: Indices
    free: bool
    segment_links: Indices
    link_parents: Indices
    link_offsets: Array
    levels: tuple[Indices, ...]
    ball_links: Indices
    hinge_links: Indices
    hinge_axes: Array
    joint_dofs: Mapping[str, Indices]
    moves: Array
    limits: Limits

    @cached_property
    def turned_links(self) -> Indices:
        """The links of all ball joints, then those of all hinges."""
        return np.concatenate([self.ball_links, self.hinge_links])

    @cached_property
    def level_parents(self) -> tuple[Indices, ...]:
        """The parents of the links at each of ``levels``."""
        return tuple(self.link_parents[level] for level in self.levels)

    @property
    def dofs(self) -> int:
        """Number n of degrees of freedom."""
        return len(self.moves)

    @property
    def ball_dofs(self) -> slice:
        """Where the ball joints stand among the degrees of freedom."""
        start = 6 if self.free else 0
        return slice(start, start + 3 * len(self.ball_links))

    @property
    def hinge_dofs(self) -> slice:
        """Where the hinges stand among the degrees of freedom."""
        return slice(self.ball_dofs.stop, self.dofs)

    def rest(self, root: Array | None = None) -> Pose:
        """The pose of zero angles, but for coupled ones, its root at T_world_root (4, 4)."""
        balls = np.tile([0.0, 0.0, 0.0, 1.0], (len(self.ball_links), 1))
        hinges = self.limits.couplings.coupled(np.zeros(len(self.hinge_links)))
        return Pose(np.eye(4) if root is None else root, balls, hinges)

    def retract(self, pose: Pose, step: Array) -> Pose:
        """The pose after a step (n,) on the tangent space at ``pose``.

        The root's translation is in the world; its rotation and those of the ball joints are
        rotation vectors in the frames that they turn, R exp(w); hinge angles add.
        """
        root = moved_root(pose.root, step) if self.free else pose.root
        balls = turned_balls(pose.balls, step[self.ball_dofs].reshape(-1, 3))
        return Pose(root, balls, pose.hinges + step[self.hinge_dofs])

    def difference(self, start: Pose, end: Pose) -> Array:
        """The step (n,) with ``retract(start, step) = end``, of at most half a turn each."""
        turns = to_vector(product(conjugate(start.balls), end.balls)).ravel()
        root = [
            end.root[:3, 3] - start.root[:3, 3],
            to_vector(from_matrix(start.root[:3, :3].T @ end.root[:3, :3])),
        ]
        return np.concatenate([*(root if self.free else []), turns, end.hinges - start.hinges])

    def violations(self, pose: Pose) -> tuple[Array, Array]:
        """How far each limit is violated, (R,) [rad], and the derivative to the dofs (R, n)."""
        violations, balls, hinges = self.limits.slopes(pose)
        jacobian = np.zeros((len(violations), self.dofs))
        count = len(self.ball_links)
        columns = self.ball_dofs.start + np.arange(3 * count).reshape(count, 3)
        rows = np.arange(count)
        jacobian[rows[:, None], columns] = balls[0]
        jacobian[count + rows[:, None], columns] = balls[1]
        own = np.arange(len(hinges))
        jacobian[2 * count + own, self.hinge_dofs.start + own] = hinges
        return violations, jacobian

    @cached_property
    def tied(self) -> NDArray[np.bool_]:
        """Which segments are one or are tied by a joint, (S, S); rigidly tied ones count as one."""
        groups = np.arange(len(self.names))
        for segment, name in enumerate(self.names):
            if self.parents[segment] >= 0 and name not in self.joint_dofs:
                groups[segment] = groups[self.parents[segment]]
        joined = np.eye(len(groups), dtype=np.bool_)
        for segment, parent in enumerate(self.parents):
            if parent >= 0:
                joined[groups[segment], groups[parent]] = True
        joined |= joined.T
        return joined[np.ix_(groups, groups)]

    def freedoms_of(self, joint: str) -> Indices:
        """The degrees of freedom of a segment's own joint.

        Raises:
            ConfigError: If there is no such joint, or it does not move.
        """
        if joint not in self.joint_dofs:
            known = list(self.joint_dofs)
            raise ConfigError(
                f"there is no joint '{joint}' (there are: {', '.join(known)})"
                + did_you_mean(joint, known)
            )
        return self.joint_dofs[joint]

    def pose(self, description: PoseDescription) -> Pose:
        """The pose that a person wrote down in degrees.

        Raises:
            ConfigError: If a joint is unknown, has another number of angles, or follows another.
        """
        root = rigid(
            vector_to_matrix(np.radians(description.root.rotation_deg)),
            np.array(description.root.position),
        )
        pose = self.rest(root)
        for name, angles in description.joints.items():
            values = np.radians(np.atleast_1d(angles))
            where = self.freedoms_of(name)
            if len(values) != len(where):
                raise ConfigError(
                    f"a pose gives {len(values)} angles for '{name}', which has {len(where)}"
                )
            if where[0] - self.hinge_dofs.start in self.limits.couplings.followers:
                raise ConfigError(f"the angle of '{name}' follows another joint's; leave it out")
            step = np.zeros(self.dofs)
            step[where] = values
            pose = self.retract(pose, step)
        return Pose(pose.root, pose.balls, self.limits.couplings.coupled(pose.hinges))
