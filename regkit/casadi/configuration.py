"""Configurations: the numbers of a pose in one vector, and the step that retracts it."""

from __future__ import annotations

from dataclasses import dataclass
from functools import lru_cache
from typing import Any

import numpy as np

from regkit.casadi import rotations
from regkit.geometry.rigid import rigid
from regkit.geometry.rotation import from_matrix, to_matrix
from regkit.skeleton import Pose, Skeleton
from regkit.system.arrays import Array
from regkit.system.errors import ConfigError
from regkit.system.optional import load_library


def configuration(skeleton: Skeleton, pose: Pose) -> Array:
    """The numbers (Q,) of a pose.

    They are the root's position [m] and quaternion (x, y, z, w) if it is free, a quaternion for
    each ball joint, and all hinge angles [rad]. A function of a configuration normalises the
    quaternions.
    """
    root = [pose.root[:3, 3], from_matrix(pose.root[:3, :3])] if skeleton.free else []
    return np.concatenate([*root, pose.balls.ravel(), pose.hinges])


def pose_of(skeleton: Skeleton, numbers: Array, root: Array | None = None) -> Pose:
    """The pose of a configuration (Q,); ``root`` is T_world_root (4, 4) where it is not free.

    Raises:
        ConfigError: If there are not Q numbers, or one is not finite.
    """
    numbers = np.asarray(numbers, dtype=float).ravel()
    if len(numbers) != length(skeleton) or not np.isfinite(numbers).all():
        raise ConfigError(
            f"a configuration of this skeleton is {length(skeleton)} finite numbers; there are "
            f"{int(np.isfinite(numbers).sum())} of {len(numbers)}"
        )
    parts = split(skeleton, numbers)
    if parts.rotation is not None:
        root = rigid(to_matrix(parts.rotation / np.linalg.norm(parts.rotation)), parts.position)
    balls = np.array([ball / np.linalg.norm(ball) for ball in parts.balls]).reshape(-1, 4)
    return Pose(np.eye(4) if root is None else root, balls, parts.hinges)


@dataclass(frozen=True)
class Parts:
    """What a configuration holds, as numbers or CasADi expressions.

    Attributes:
        position: Of the root, (3,) [m]; None where the root is fixed.
        rotation: Its quaternion (4,); None where the root is fixed.
        balls: A quaternion (4,) for each ball joint.
        hinges: All hinge angles (n_hinge,) [rad].
    """

    position: Any
    rotation: Any
    balls: list[Any]
    hinges: Any


def length(skeleton: Skeleton) -> int:
    """How many numbers Q a configuration of a skeleton has."""
    root = 7 if skeleton.free else 0
    return root + 4 * len(skeleton.ball_links) + len(skeleton.hinge_links)


def split(skeleton: Skeleton, numbers: Any) -> Parts:
    """The parts of a configuration (Q,)."""
    first = 7 if skeleton.free else 0
    last = first + 4 * len(skeleton.ball_links)
    return Parts(
        position=numbers[:3] if skeleton.free else None,
        rotation=numbers[3:7] if skeleton.free else None,
        balls=[numbers[at : at + 4] for at in range(first, last, 4)],
        hinges=numbers[last:],
    )


@lru_cache(maxsize=16)
def retract(skeleton: Skeleton) -> Any:
    """The CasADi function (configuration (Q,), step (n,)) -> configuration (Q,).

    The same steps as ``Skeleton.retract`` takes: a translation in the world, rotation vectors in
    the frames that they turn, hinge angles. A step knows of no coupling; ``joint_limits`` does.
    """
    ca = load_library("casadi")
    numbers = ca.SX.sym("configuration", length(skeleton))
    step = ca.SX.sym("step", skeleton.dofs)
    parts = split(skeleton, numbers)
    moved = []
    if skeleton.free:
        turned = rotations.product(parts.rotation, rotations.exponential(step[3:6]))
        moved += [parts.position + step[:3], turned]
    first = skeleton.ball_dofs.start
    for index, ball in enumerate(parts.balls):
        at = first + 3 * index
        moved.append(rotations.product(ball, rotations.exponential(step[at : at + 3])))
    moved.append(parts.hinges + step[skeleton.hinge_dofs])
    return ca.Function(
        "retract", [numbers, step], [ca.vertcat(*moved)],
        ["configuration", "step"], ["moved"],
    )  # fmt: skip
