"""Mirroring: the pose of a two-sided skeleton with left and right exchanged."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from regkit.geometry.rigid import rigid
from regkit.skeleton.placement import Placement
from regkit.skeleton.pose import Pose
from regkit.skeleton.skeleton import Skeleton
from regkit.system.arrays import Array, Indices

TOLERANCE = 0.02
"""Distance between a joint and its mirror image, as a fraction of the skeleton's extent; the sides
of a person are not quite equal."""

PARALLEL = 0.95
"""Least cosine between a hinge's axis and that of its mirror image."""


@dataclass(frozen=True)
class Mirroring:
    """The exchange of the sides of a skeleton that is its own mirror image at rest.

    Attributes:
        normal: Normal of the plane of symmetry in the root's frame, (3,).
        balls: Ball joint on the other side of each, (n_ball,).
        rotations: Matrices that mirror the vector part of a ball's quaternion into the frame of its
            counterpart, (n_ball, 3, 3).
        hinges: Hinge on the other side of each, (n_hinge,).
        signs: 1 or -1: sign of its angle or displacement, (n_hinge,).
    """

    normal: Array
    balls: Indices
    rotations: Array
    hinges: Indices
    signs: Array

    @classmethod
    def of(cls, skeleton: Skeleton) -> Mirroring | None:
        """Returns the mirroring of a skeleton; None if it is not its own mirror image."""
        for normal in np.eye(3):
            found = _mirroring(skeleton, normal)
            if found is not None:
                return found
        return None

    def mirrored(self, pose: Pose, plane: Array, through: Array) -> Pose:
        """Returns the pose whose body is the mirror image of the body, about a plane in the world.

        Args:
            pose: The pose.
            plane: Unit normal of the plane, (3,).
            through: A point of the plane, (3,) [m].
        """
        reflection = np.eye(3) - 2.0 * np.outer(plane, plane)
        own = np.eye(3) - 2.0 * np.outer(self.normal, self.normal)
        root = rigid(
            reflection @ pose.root[:3, :3] @ own,
            through + reflection @ (pose.root[:3, 3] - through),
        )
        return Pose(root, *self.sides(pose.balls, pose.hinges))

    def sides(self, balls: Array, hinges: Array) -> tuple[Array, Array]:
        """Returns joints with left and right exchanged.

        Args:
            balls: Unit quaternions of the ball joints, (..., n_ball, 4).
            hinges: Hinge angles, (..., n_hinge) [rad].
        """
        own_balls, own_hinges = np.empty_like(balls), np.empty_like(hinges)
        own_balls[..., self.balls, :3] = (self.rotations @ balls[..., :3, None])[..., 0]
        own_balls[..., self.balls, 3] = balls[..., 3]
        own_hinges[..., self.hinges] = self.signs * hinges
        return own_balls, own_hinges


def _mirroring(skeleton: Skeleton, normal: Array) -> Mirroring | None:
    """Returns the mirroring about the plane through the root with a normal (3,), or None."""
    links = Placement.of(skeleton, skeleton.rest()).links
    origins, frames = links[:, :3, 3], links[:, :3, :3]
    # At the rest pose coupled hinges may be bent; their offsets are small against the tolerance.
    image = origins @ (np.eye(3) - 2.0 * np.outer(normal, normal))
    extent = float(np.ptp(origins, axis=0).max())
    gaps = np.linalg.norm(image[:, None] - origins, axis=2)
    # An axial vector keeps its part along the normal, and the rest changes sign.
    axial = 2.0 * np.outer(normal, normal) - np.eye(3)
    turned = axial @ frames
    along = _alignment(skeleton, frames, axial)
    balls = _counterparts(gaps[np.ix_(skeleton.ball_links, skeleton.ball_links)], extent)
    apart = gaps[np.ix_(skeleton.hinge_links, skeleton.hinge_links)].copy()
    # Two hinges of a universal joint share their origin.
    apart[np.abs(along) < PARALLEL] = np.inf
    hinges = _counterparts(apart, extent)
    if balls is None or hinges is None or not _exchanges(balls, hinges):
        return None
    each = np.arange(len(hinges))
    ball_links = skeleton.ball_links
    others = frames[ball_links[balls]]
    return Mirroring(
        normal=normal,
        balls=balls,
        rotations=np.swapaxes(others, 1, 2) @ turned[ball_links],
        hinges=hinges,
        signs=np.sign(along[each, hinges]),
    )


def _alignment(skeleton: Skeleton, frames: Array, axial: Array) -> Array:
    """Returns the cosine between each mirrored hinge's axis and every hinge's, (n_hinge, n_hinge).

    It is zero between a hinge and a prismatic joint.

    Args:
        skeleton: The skeleton.
        frames: Rotations of its links at rest, (L, 3, 3).
        axial: The mirror image of rotation axes, (3, 3); directions have the opposite sign.
    """
    own = frames[skeleton.hinge_links]
    slides = (own @ skeleton.hinge_twists[:, :3, None])[:, :, 0]
    axes = (own @ skeleton.hinge_twists[:, 3:, None])[:, :, 0]
    return np.asarray((axes @ axial.T) @ axes.T - (slides @ axial.T) @ slides.T)


def _counterparts(gaps: Array, extent: float) -> Indices | None:
    """Returns the nearest joint of each mirrored one (N,); None if it is not one to one."""
    if not len(gaps):
        return np.zeros(0, dtype=np.intp)
    nearest = gaps.argmin(axis=1)
    if gaps.min(axis=1).max() > TOLERANCE * extent or len(set(nearest.tolist())) < len(nearest):
        return None
    return np.asarray(nearest)


def _exchanges(balls: Indices, hinges: Indices) -> bool:
    """Returns whether any joint has its counterpart on another side: a chain in a plane has not."""
    return bool((balls != np.arange(len(balls))).any() or (hinges != np.arange(len(hinges))).any())
