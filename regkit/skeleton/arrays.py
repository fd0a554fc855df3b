"""The arrays of a skeleton, as compiled functions take them."""

from __future__ import annotations

from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from regkit.skeleton.limits import Limits
from regkit.system.arrays import loop_input
from regkit.system.machine_types import IntegerVector, Matrix, Stack, Vector

if TYPE_CHECKING:
    from regkit.skeleton.pose import Pose
    from regkit.skeleton.skeleton import Skeleton


class PoseArrays(NamedTuple):
    """A pose; see ``Pose``.

    Attributes:
        root: T_world_root, (4, 4) [m].
        balls: Unit quaternion (x, y, z, w) of each ball joint, (n_ball, 4).
        hinges: Angle of each hinge, (n_hinge,) [rad].
    """

    root: Matrix
    balls: Matrix
    hinges: Vector

    @classmethod
    def of(cls, pose: Pose) -> PoseArrays:
        """Returns the arrays of a pose."""
        return cls(loop_input(pose.root), loop_input(pose.balls), loop_input(pose.hinges))


class LimitArrays(NamedTuple):
    """Joint limits; see ``Limits`` and ``Couplings``.

    Attributes:
        hinges: Lower and upper angle, (n_hinge, 2) [rad].
        leaders: Hinge that each hinge follows, (n_hinge,); itself if it follows none.
        ratios: Ratio of each coupling, (n_hinge,); 1 without one.
        offsets: Offset of each coupling, (n_hinge,) [rad]; 0 without one.
        variables: Position of each hinge, or of its leader, among the independent ones, (n_hinge,).
        centres: Centre of each ball's swing cone as a unit quaternion, (n_ball, 4).
        twist_axes: Unit vectors in the segment frames, (n_ball, 3).
        cones: Swing axes divided by the half angles of the cone, (n_ball, 2, 3) [1/rad].
        twists: Lower and upper twist, (n_ball, 2) [rad].
    """

    hinges: Matrix
    leaders: IntegerVector
    ratios: Vector
    offsets: Vector
    variables: IntegerVector
    centres: Matrix
    twist_axes: Matrix
    cones: Stack
    twists: Matrix

    @classmethod
    def of(cls, limits: Limits) -> LimitArrays:
        """Returns the arrays of limits."""
        couplings = limits.couplings
        leaders = np.arange(couplings.hinges)
        ratios, offsets = np.ones(couplings.hinges), np.zeros(couplings.hinges)
        leaders[couplings.followers] = couplings.leaders
        ratios[couplings.followers] = couplings.ratios
        offsets[couplings.followers] = couplings.offsets
        variables = np.zeros(couplings.hinges, dtype=np.int64)
        variables[couplings.independent] = np.arange(len(couplings.independent))
        return cls(
            hinges=np.array(limits.hinge, order="C"),
            leaders=leaders,
            ratios=ratios,
            offsets=offsets,
            variables=variables[leaders],
            centres=np.array(limits.centre, order="C"),
            twist_axes=np.array(limits.twist_axis, order="C"),
            cones=np.array(limits.cone, order="C"),
            twists=np.array(limits.twist, order="C"),
        )


class SkeletonArrays(NamedTuple):
    """A skeleton; see ``Skeleton``.

    Attributes:
        first: Number of degrees of freedom of the root, 6 or 0.
        parents: Index of each segment's parent, (S,); -1 for the root.
        segment_links: Link of each segment, (S,).
        link_parents: Index of each link's parent, (L,); -1 for the root.
        link_offsets: T_parent_joint of each link at rest, (L, 4, 4).
        ball_links: Link of each ball joint, (n_ball,).
        hinge_links: Link of each hinge, (n_hinge,).
        hinge_twists: Unit twist of each hinge in its link frame, linear first, (n_hinge, 6): an
            axis of rotation, or the direction of a prismatic joint.
        dof_mask: 1 where a degree of freedom moves a segment, else 0, (n, S).
        dof_segments: The first segment that each degree of freedom moves, (n,); the others are its
            descendants.
        limits: Joint limits.
    """

    first: int
    parents: IntegerVector
    segment_links: IntegerVector
    link_parents: IntegerVector
    link_offsets: Stack
    ball_links: IntegerVector
    hinge_links: IntegerVector
    hinge_twists: Matrix
    dof_mask: Matrix
    dof_segments: IntegerVector
    limits: LimitArrays

    @classmethod
    def of(cls, skeleton: Skeleton) -> SkeletonArrays:
        """Returns the arrays of a skeleton."""
        return cls(
            first=skeleton.ball_dofs.start,
            parents=_integers(skeleton.parents),
            segment_links=_integers(skeleton.segment_links),
            link_parents=_integers(skeleton.link_parents),
            link_offsets=np.array(skeleton.link_offsets, order="C"),
            ball_links=_integers(skeleton.ball_links),
            hinge_links=_integers(skeleton.hinge_links),
            hinge_twists=np.array(skeleton.hinge_twists, order="C"),
            dof_mask=np.array(skeleton.dof_mask, dtype=np.float64, order="C"),
            dof_segments=_integers(skeleton.dof_mask.argmax(axis=1)),
            limits=LimitArrays.of(skeleton.limits),
        )


def _integers(indices: object) -> IntegerVector:
    return np.array(indices, dtype=np.int64, order="C")
