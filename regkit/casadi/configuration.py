"""Configurations: poses as vectors, and their retraction."""

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
    """Returns the configuration (Q,) of a pose.

    It is the concatenation of the position [m] and quaternion (x, y, z, w) of a free root, the
    quaternions of all ball joints, and all hinge angles [rad]. Functions of a configuration
    normalise the quaternions.
    """
    root = [pose.root[:3, 3], from_matrix(pose.root[:3, :3])] if skeleton.free else []
    return np.concatenate([*root, pose.balls.ravel(), pose.hinges])


def pose_of(skeleton: Skeleton, numbers: Array, root: Array | None = None) -> Pose:
    """Returns the pose of a configuration.

    Args:
        skeleton: The skeleton.
        numbers: The configuration, (Q,).
        root: T_world_root (4, 4) of a skeleton whose root is fixed; the identity by default.

    Raises:
        ConfigError: If the configuration does not have Q finite numbers.
    """
    numbers = np.asarray(numbers, dtype=float).ravel()
    if len(numbers) != length(skeleton) or not np.isfinite(numbers).all():
        raise ConfigError(
            f"a configuration of this skeleton has {length(skeleton)} finite numbers; the given "
            f"one has {len(numbers)} numbers, of which {int(np.isfinite(numbers).sum())} are finite"
        )
    parts = split(skeleton, numbers)
    if parts.rotation is not None:
        root = rigid(to_matrix(parts.rotation / np.linalg.norm(parts.rotation)), parts.position)
    balls = np.array([ball / np.linalg.norm(ball) for ball in parts.balls]).reshape(-1, 4)
    return Pose(np.eye(4) if root is None else root, balls, parts.hinges)


@dataclass(frozen=True)
class Parts:
    """The parts of a configuration, as numbers or CasADi expressions.

    Attributes:
        position: Position of the root, (3,) [m]; None if the root is fixed.
        rotation: Quaternion of the root, (4,); None if the root is fixed.
        balls: Quaternion (4,) of each ball joint.
        hinges: Hinge angles, (n_hinge,) [rad].
    """

    position: Any
    rotation: Any
    balls: list[Any]
    hinges: Any


def length(skeleton: Skeleton) -> int:
    """Returns the length Q of a skeleton's configuration."""
    root = 7 if skeleton.free else 0
    return root + 4 * len(skeleton.ball_links) + len(skeleton.hinge_links)


def split(skeleton: Skeleton, numbers: Any) -> Parts:
    """Splits a configuration (Q,) into its parts."""
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
    """Returns the CasADi function (configuration (Q,), step (n,)) -> configuration (Q,).

    The step is that of ``Skeleton.retract``: a translation in the world, rotation vectors in the
    rotated frames, and hinge angles. It does not enforce couplings; ``joint_limits`` does.

    Raises:
        DependencyError: If CasADi is missing.
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
