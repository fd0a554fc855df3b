"""Poses: where the root is and how every joint is turned."""

from __future__ import annotations

from dataclasses import dataclass

from pydantic import Field

from regkit.config.model import Model
from regkit.skeleton.joints import Vector
from regkit.system.arrays import Array


@dataclass(frozen=True)
class Pose:
    """A configuration of a skeleton.

    Attributes:
        root: T_world_root, (4, 4) [m].
        balls: One unit quaternion (x, y, z, w) for each ball joint, (n_ball, 4).
        hinges: One angle for each hinge, a universal joint having two, (n_hinge,) [rad].
    """

    root: Array
    balls: Array
    hinges: Array


class RootDescription(Model):
    """Where the root is."""

    position: Vector = (0.0, 0.0, 0.0)
    """Position of the root's origin in the world [m]."""
    rotation_deg: Vector = (0.0, 0.0, 0.0)
    """Rotation vector of the root's frame in the world [deg]."""


class PoseDescription(Model):
    """A pose as a person writes it; what is not named stays at rest."""

    root: RootDescription = RootDescription()
    """Where the root is."""
    joints: dict[str, float | tuple[float, float] | Vector] = Field(default_factory=dict)
    """By segment: a hinge's angle, a universal joint's two, or a ball's rotation vector [deg]."""
