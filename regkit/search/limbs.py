"""Limbs: chains of segments attached to a body's trunk."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from regkit.skeleton import Pose, Skeleton
from regkit.system.arrays import Array, Indices


@dataclass(frozen=True)
class Limb:
    """A chain without branches: an arm, a leg, a head, a finger.

    Attributes:
        name: Name of its first segment.
        parent: Index of the trunk segment to which it is attached.
        segments: Indices of its segments from the trunk outwards, (L,).
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


def limbs_of(skeleton: Skeleton) -> list[Limb]:
    """Returns the movable limbs; the trunk consists of branching segments and their ancestors."""
    count = len(skeleton.names)
    children = [np.flatnonzero(skeleton.parents == segment) for segment in range(count)]
    limbs = []
    for segment in range(count):
        parent = int(skeleton.parents[segment])
        # A body that is free in the scene is no limb.
        if parent < 0 or len(children[parent]) < 2 or skeleton.is_free(skeleton.names[segment]):
            continue
        chain = [segment]
        while len(children[chain[-1]]) == 1:
            chain.append(int(children[chain[-1]][0]))
        if len(children[chain[-1]]):
            continue
        nothing = np.zeros(0, dtype=np.intp)
        own = np.concatenate([skeleton.joint_dofs.get(skeleton.names[s], nothing) for s in chain])
        balls, hinges = skeleton.ball_dofs, skeleton.hinge_dofs
        of_balls = own[(own >= balls.start) & (own < balls.stop)] - balls.start
        of_hinges = own[own >= hinges.start] - hinges.start
        if len(own):
            name = skeleton.names[segment]
            limbs.append(Limb(name, parent, np.array(chain), np.unique(of_balls // 3), of_hinges))
    return limbs
