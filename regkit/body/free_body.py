"""One of several bodies that move freely beside each other: alone, and in the whole."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Self

import numpy as np

from regkit.geometry.rigid import inverse, rigid
from regkit.geometry.rotation import from_matrix, to_matrix
from regkit.skeleton import Pose
from regkit.system.arrays import Array, Indices
from regkit.system.brief import Brief

if TYPE_CHECKING:
    from regkit.body.body import Body


@dataclass(frozen=True)
class FreeBody(Brief):
    """A body that moves freely beside others, and where its joints are in the whole.

    Attributes:
        name: Its name.
        body: The body alone.
        segments: Index of each of its segments among those of the whole, (S,).
        markers: Index of each of its markers among those of the whole, (M,).
        balls: Index of each of its ball joints among those of the whole, (n_ball,).
        hinges: Index of each of its hinges among those of the whole, (n_hinge,).
        root: Indices of its root's three displacements among the hinges of the whole, and of its
            root's rotation among the ball joints, (4,); empty if its root is fixed.
        T_world_rest: Pose of its root at rest, (4, 4) [m].
    """

    name: str
    body: Body
    segments: Indices
    markers: Indices
    balls: Indices
    hinges: Indices
    root: Indices
    T_world_rest: Array

    @classmethod
    def of(cls, name: str, body: Body, whole: Body, prefix: str) -> Self:
        """Returns a body beside others.

        Args:
            name: Its name.
            body: The body alone.
            whole: All bodies as one.
            prefix: What the names of its segments and markers have before them in the whole.
        """
        bones, own = whole.skeleton, body.skeleton
        root = np.zeros(0, dtype=np.intp)
        first = prefix + own.names[0]
        if bones.is_free(first):
            slides = bones.joint_dofs[first][:3] - bones.hinge_dofs.start
            root = np.array([*slides, bones.ball_names.index(first)], dtype=np.intp)
        return cls(
            name,
            body,
            _places(prefix, own.names, bones.names),
            _places(prefix, body.markers.names, whole.markers.names),
            _places(prefix, own.ball_names, bones.ball_names),
            _places(prefix, own.hinge_names, bones.hinge_names),
            root,
            body.place(own.rest()).transforms[0],
        )

    def alone(self, pose: Pose) -> Pose:
        """Returns the body's own pose in a pose of the whole."""
        root = self.body.skeleton.rest().root
        if len(self.root):
            moved = rigid(to_matrix(pose.balls[self.root[3]]), pose.hinges[self.root[:3]])
            root = self.T_world_rest @ moved @ inverse(self.T_world_rest)
        return Pose(root, pose.balls[self.balls], pose.hinges[self.hinges])

    def placed(self, own: Pose, pose: Pose) -> Pose:
        """Returns the pose of the whole in which this body has its own pose.

        Args:
            own: The body's own pose.
            pose: A pose of the whole, which gives the other bodies.
        """
        balls, hinges = pose.balls.copy(), pose.hinges.copy()
        balls[self.balls], hinges[self.hinges] = own.balls, own.hinges
        if len(self.root):
            moved = inverse(self.T_world_rest) @ own.root @ self.T_world_rest
            hinges[self.root[:3]] = moved[:3, 3]
            balls[self.root[3]] = from_matrix(moved[:3, :3])
        return Pose(pose.root, balls, hinges)


def _places(prefix: str, own: tuple[str, ...], all_names: tuple[str, ...]) -> Indices:
    """Returns where names with a prefix are among others, (N,)."""
    return np.array([all_names.index(prefix + name) for name in own], dtype=np.intp)
