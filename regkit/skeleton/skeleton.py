"""Skeletons: a tree of segments, its degrees of freedom, and retraction of its poses."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from regkit.config.model import did_you_mean
from regkit.geometry.rigid import rigid
from regkit.geometry.rotation import (
    vector_to_matrix,
)
from regkit.skeleton.arrays import PoseArrays, SkeletonArrays
from regkit.skeleton.compiled_difference import pose_difference
from regkit.skeleton.compiled_steps import retracted_balls, retracted_root
from regkit.skeleton.limits import Limits
from regkit.skeleton.pose import JointAngles, Pose, PoseDescription, RootDescription
from regkit.skeleton.spread import spread_variances
from regkit.system.arrays import Array, Indices
from regkit.system.brief import Brief
from regkit.system.errors import ConfigError, FieldError

FREE = 6
"""Number of degrees of freedom of a free joint."""

_SUFFIXES = {0: (), 1: ("",), 2: (".first", ".second"), 3: (".x", ".y", ".z")}
"""What the names of a joint's hinges have after its segment's, by their number."""


@dataclass(frozen=True, eq=False)
class Skeleton(Brief):
    """A tree of *links*, each with at most one joint, built by ``regkit.skeleton.compile``.

    A universal joint is two hinges, the first of them on a virtual link. So every link's joint is
    free (the root only), a ball, a hinge or fixed, and a segment is the last link of its joint. A
    prismatic joint counts as a hinge, with a displacement [m] in place of an angle [rad]. A free
    joint of another segment than the root is three displacements along x, y and z, then a ball.

    The degrees of freedom are ordered: translation (3) and rotation (3) of a free root, three per
    ball joint, one per hinge.

    Attributes:
        names: Names of the S segments, parents before children.
        parents: Index of each segment's parent, (S,); -1 for the root.
        free: Whether the root has a free joint.
        segment_links: Link of each segment, (S,).
        link_parents: Index of each link's parent, (L,); -1 for the root.
        link_offsets: T_parent_joint of each link at rest, (L, 4, 4).
        ball_links: Link of each ball joint, (n_ball,).
        hinge_links: Link of each hinge, (n_hinge,).
        hinge_twists: Unit twist of each hinge in its link frame, linear first, (n_hinge, 6): an
            axis of rotation, or the direction of a prismatic joint.
        joint_dofs: Indices of the degrees of freedom of each joint, by segment name.
        dof_mask: 1 where a degree of freedom moves a segment, else 0, (n, S).
        limits: Joint limits.
    """

    names: tuple[str, ...]
    parents: Indices
    free: bool
    segment_links: Indices
    link_parents: Indices
    link_offsets: Array
    ball_links: Indices
    hinge_links: Indices
    hinge_twists: Array
    joint_dofs: Mapping[str, Indices]
    dof_mask: Array
    limits: Limits

    def __repr__(self) -> str:
        """Returns the numbers of segments and joints, in one line."""
        root = "free" if self.free else "fixed"
        return (
            f"<Skeleton of {len(self.names)} segments: {root} root, {len(self.ball_links)} ball "
            f"joints, {len(self.hinge_links)} hinges, {self.dofs} degrees of freedom>"
        )

    @property
    def dofs(self) -> int:
        """Number n of degrees of freedom."""
        return len(self.dof_mask)

    @property
    def ball_dofs(self) -> slice:
        """Indices of the ball joints among the degrees of freedom."""
        start = 6 if self.free else 0
        return slice(start, start + 3 * len(self.ball_links))

    @property
    def hinge_dofs(self) -> slice:
        """Indices of the hinges among the degrees of freedom."""
        return slice(self.ball_dofs.stop, self.dofs)

    @cached_property
    def independent_dofs(self) -> Indices:
        """Indices of the m degrees of freedom that are not those of coupled hinges, (m,)."""
        followers = self.hinge_dofs.start + self.limits.couplings.followers
        return np.setdiff1d(np.arange(self.dofs), followers)

    @cached_property
    def arrays(self) -> SkeletonArrays:
        """The skeleton as compiled functions take it."""
        return SkeletonArrays.of(self)

    @cached_property
    def ball_names(self) -> tuple[str, ...]:
        """Name of the segment of each ball joint, (n_ball,)."""
        segments = dict(zip(self.segment_links.tolist(), self.names, strict=True))
        return tuple(segments[link] for link in self.ball_links.tolist())

    @cached_property
    def hinge_names(self) -> tuple[str, ...]:
        """Name of each hinge, (n_hinge,): its segment's, with a suffix where a joint has several.

        A universal joint has ``NAME.first`` and ``NAME.second``; a free one has ``NAME.x``, ``.y``
        and ``.z``.
        """
        names = [""] * len(self.hinge_links)
        start = self.hinge_dofs.start
        for segment, dofs in self.joint_dofs.items():
            own = [dof - start for dof in dofs.tolist() if dof >= start]
            for hinge, suffix in zip(own, _SUFFIXES[len(own)], strict=True):
                names[hinge] = segment + suffix
        return tuple(names)

    @cached_property
    def free_segments(self) -> Indices:
        """Indices of the segments other than the root whose joint is free, (F,)."""
        found = [index for index, name in enumerate(self.names) if self.is_free(name)]
        return np.array(found, dtype=np.intp)

    @cached_property
    def free_dofs(self) -> Indices:
        """Indices of the degrees of freedom of all free joints, (6 R,); the root's come first.

        Each joint has three translations, then three rotations.
        """
        own = [self.joint_dofs[self.names[segment]] for segment in self.free_segments]
        return np.concatenate([np.arange(self.ball_dofs.start), *own]).astype(np.intp)

    @cached_property
    def hinge_columns(self) -> tuple[str, ...]:
        """Name of each hinge with its unit, (n_hinge,): ``NAME_rad``, ``NAME_m`` if prismatic."""
        units = np.where(self.limits.prismatic, "m", "rad")
        return tuple(f"{name}_{unit}" for name, unit in zip(self.hinge_names, units, strict=True))

    def rest(self, root: Array | None = None) -> Pose:
        """Returns the rest pose: zero angles, except for the offsets of coupled hinges.

        Args:
            root: T_world_root, (4, 4); the identity by default.
        """
        balls = np.tile([0.0, 0.0, 0.0, 1.0], (len(self.ball_links), 1))
        hinges = self.limits.couplings.coupled(np.zeros(len(self.hinge_links)))
        return Pose(np.eye(4) if root is None else root, balls, hinges)

    def retract(self, pose: Pose, step: Array) -> Pose:
        """Returns the pose after a step (n,) on the tangent space at ``pose``.

        The root's translation [m] is in the world; the rotations of the root and of ball joints are
        rotation vectors [rad] in the rotated frame, R exp(w); hinge angles [rad] add.
        """
        root = retracted_root(pose.root, step) if self.free else pose.root
        balls = retracted_balls(pose.balls, step[self.ball_dofs].reshape(-1, 3))
        return Pose(root, balls, pose.hinges + step[self.hinge_dofs])

    def difference(self, start: Pose, end: Pose) -> Array:
        """Returns the step (n,) with ``retract(start, step) = end``; rotations are at most pi."""
        return pose_difference(PoseArrays.of(start), PoseArrays.of(end), self.dofs)

    @cached_property
    def spread(self) -> Array:
        """Covariance (n, n) of poses that are spread evenly over the joint limits."""
        return spread_variances(self.limits, free=self.free)

    @cached_property
    def spread_information(self) -> Array:
        """Inverse of ``spread``, (n, n); zero for coupled hinges, which add nothing."""
        own = np.ix_(self.independent_dofs, self.independent_dofs)
        information = np.zeros_like(self.spread)
        information[own] = np.linalg.inv(self.spread[own])
        return information

    def violations(self, pose: Pose) -> tuple[Array, Array]:
        """Returns the violation of each limit (R,) [rad] and its Jacobian (R, n) to the dofs."""
        violations, balls, hinges = self.limits.linearized(pose)
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
    def adjacent(self) -> NDArray[np.bool_]:
        """Whether two segments are the same or connected by a joint, (S, S).

        Segments connected by fixed joints count as one.
        """
        groups = np.arange(len(self.names))
        for segment, name in enumerate(self.names):
            if self.parents[segment] >= 0 and name not in self.joint_dofs:
                groups[segment] = groups[self.parents[segment]]
        joined = np.eye(len(groups), dtype=np.bool_)
        for segment, parent in enumerate(self.parents):
            if parent >= 0 and segment not in self.free_segments:
                joined[groups[segment], groups[parent]] = True
        joined |= joined.T
        return joined[np.ix_(groups, groups)]

    def dofs_of(self, joint: str) -> Indices:
        """Returns the indices of the degrees of freedom of a segment's joint.

        Raises:
            ConfigError: If there is no such segment, or its joint is fixed.
        """
        if joint not in self.joint_dofs:
            known = list(self.joint_dofs)
            raise ConfigError(
                f"no segment '{joint}' has a moving joint (there are: {', '.join(known)})"
                + did_you_mean(joint, known)
            )
        return self.joint_dofs[joint]

    def rotating(self, joint: str, *location: str) -> Indices:
        """Returns the indices of the rotations among the degrees of freedom of a segment's joint.

        Args:
            joint: The segment.
            location: Field whose degrees are the joint's, for the place of a mistake.

        Raises:
            FieldError: If there is no such segment, or its joint is fixed or prismatic.
        """
        try:
            dofs = self.dofs_of(joint)
        except ConfigError as error:
            raise FieldError(error.message, *location, joint) from None
        if self.is_prismatic(joint):
            raise FieldError(
                f"the joint of '{joint}' is prismatic, and degrees are for joints that rotate; "
                "give [m] for all prismatic joints in the field 'displacement'",
                *location,
                joint,
            )
        return dofs[3:] if self.is_free(joint) else dofs

    def is_prismatic(self, joint: str) -> bool:
        """Returns whether the moving joint of a segment is prismatic."""
        dofs = self.dofs_of(joint)
        hinge = int(dofs[0]) - self.hinge_dofs.start
        return len(dofs) == 1 and hinge >= 0 and bool(self.limits.prismatic[hinge])

    def is_free(self, segment: str) -> bool:
        """Returns whether the joint of a segment other than the root is free."""
        return len(self.joint_dofs.get(segment, ())) == FREE

    def pose(self, description: PoseDescription, scale: float = 1.0) -> Pose:
        """Returns the pose of a YAML description, with displacements of joints times a scale.

        Raises:
            FieldError: If a joint is unknown, the number of its angles is wrong, or it is coupled
                to another.
        """
        root = rigid(
            vector_to_matrix(np.radians(description.root.rotation_deg)),
            np.array(description.root.position),
        )
        pose = self.rest(root)
        for name, angles in description.joints.items():
            try:
                dofs = self.dofs_of(name)
            except ConfigError as error:
                raise FieldError(error.message, "joints", name) from None
            values = self._joint_step(name, angles, scale)
            if len(values) != len(dofs):
                raise FieldError(
                    f"the pose gives {len(values)} angles for '{name}'; its joint has {len(dofs)}",
                    "joints",
                    name,
                )
            if dofs[0] - self.hinge_dofs.start in self.limits.couplings.followers:
                raise FieldError(
                    f"the joint of '{name}' is coupled to another joint; leave its angle out",
                    "joints",
                    name,
                )
            step = np.zeros(self.dofs)
            step[dofs] = values
            pose = self.retract(pose, step)
        return Pose(pose.root, pose.balls, self.limits.couplings.coupled(pose.hinges))

    def _joint_step(self, name: str, angles: JointAngles, scale: float) -> Array:
        """Returns the step of a joint's degrees of freedom from rest [m or rad]."""
        if isinstance(angles, RootDescription):
            return np.concatenate(
                [scale * np.array(angles.position), np.radians(angles.rotation_deg)]
            )
        values = np.atleast_1d(angles)
        return np.asarray(scale * values if self.is_prismatic(name) else np.radians(values))
