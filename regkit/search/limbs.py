"""Limbs: chains of segments attached to a body's trunk."""

from __future__ import annotations

from dataclasses import dataclass
from typing import NamedTuple

import numpy as np

from regkit.body import Body
from regkit.skeleton import Pose
from regkit.system.arrays import Array, Indices


@dataclass(frozen=True)
class Limb:
    """A chain without branches, but for a part at its end: an arm, a leg, a head, a finger.

    Attributes:
        name: Name of its first segment.
        parent: Index of the trunk segment to which it is attached.
        segments: Indices of its segments from the trunk outwards, (L,), and of the part at its end.
        balls: Indices of its ball joints among the skeleton's, (B,).
        hinges: Indices of its hinges among the skeleton's, (H,).
    """

    name: str
    parent: int
    segments: Indices
    balls: Indices
    hinges: Indices

    def rotated(self, pose: Pose, balls: Array, hinges: Array) -> Pose:
        """Returns poses (...) that take this limb's joints from other configurations.

        Args:
            pose: A single pose, which provides all other joints.
            balls: Unit quaternions of all ball joints, (..., n_ball, 4).
            hinges: Angles of all hinges, (..., n_hinge) [rad].
        """
        all_balls = np.tile(pose.balls, (*hinges.shape[:-1], 1, 1))
        all_hinges = np.tile(pose.hinges, (*hinges.shape[:-1], 1))
        all_balls[..., self.balls, :] = balls[..., self.balls, :]
        all_hinges[..., self.hinges] = hinges[..., self.hinges]
        return Pose(pose.root, all_balls, all_hinges)


def limbs_of(body: Body) -> list[Limb]:
    """Returns the movable limbs; the trunk consists of branching segments and their ancestors.

    Each part of a composed body has limbs of its own, such as the fingers of a hand. What a part is
    attached to ends with it: an arm ends with the hand, whose fingers keep their pose.
    """
    skeleton, below = body.skeleton, _below(body)
    limbs = []
    for segment, parent in enumerate(skeleton.parents.tolist()):
        # A body that is free in the scene is no limb.
        if parent < 0 or len(below.children[parent]) < 2 or segment in skeleton.free_segments:
            continue
        chain = [segment]
        while chain[-1] not in below.parts and len(below.children[chain[-1]]) == 1:
            chain.append(below.children[chain[-1]][0])
        end = chain[-1]
        if end not in below.parts and len(below.children[end]):
            continue
        segments = np.array([*chain[:-1], *below.parts.get(end, [end])], dtype=np.intp)
        nothing = np.zeros(0, dtype=np.intp)
        own = np.concatenate([skeleton.joint_dofs.get(skeleton.names[s], nothing) for s in chain])
        balls, hinges = skeleton.ball_dofs, skeleton.hinge_dofs
        of_balls = own[(own >= balls.start) & (own < balls.stop)] - balls.start
        of_hinges = own[own >= hinges.start] - hinges.start
        if len(own):
            name = skeleton.names[segment]
            limbs.append(Limb(name, parent, segments, np.unique(of_balls // 3), of_hinges))
    return limbs


def part_limbs_of(body: Body) -> list[Limb]:
    """Returns each attached part as a limb as a whole, with the joint that attaches it."""
    skeleton = body.skeleton
    first, hinges = skeleton.ball_dofs.start, skeleton.hinge_dofs.start
    return [
        Limb(
            name=skeleton.names[part.segments[0]],
            parent=int(skeleton.parents[part.segments[0]]),
            segments=part.segments,
            balls=np.unique((part.dofs[part.dofs < hinges] - first) // 3),
            hinges=part.dofs[part.dofs >= hinges] - hinges,
        )
        for part in body.attached_parts
    ]


class _Below(NamedTuple):
    """What hangs on the segments of a body.

    Attributes:
        children: Children of each segment.
        parts: Segments of each part that is attached to another, by its first segment.
    """

    children: list[list[int]]
    parts: dict[int, list[int]]


def _below(body: Body) -> _Below:
    parents = body.skeleton.parents
    children = [np.flatnonzero(parents == segment).tolist() for segment in range(len(parents))]
    attached = {int(part.segments[0]): part.segments.tolist() for part in body.attached_parts}
    return _Below(children, attached)
