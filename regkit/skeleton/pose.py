"""Poses: the root transform and all joint angles of a skeleton."""

from __future__ import annotations

from dataclasses import dataclass

from pydantic import Field

from regkit.config.model import Model
from regkit.config.quantities import Angle, WorldCoordinate
from regkit.skeleton.joints import Rotation
from regkit.system.arrays import Array


@dataclass(frozen=True)
class Pose:
    """A configuration of a skeleton.

    Attributes:
        root: T_world_root, (4, 4) [m].
        balls: Unit quaternion (x, y, z, w) of each ball joint, (n_ball, 4).
        hinges: Angle [rad] of each hinge, displacement [m] of each prismatic joint, (n_hinge,); a
            universal joint has two hinges.
    """

    root: Array
    balls: Array
    hinges: Array

    def moved(self, T_new_world: Array) -> Pose:
        """Returns the pose in another world, such as the frame of a camera.

        Args:
            T_new_world: Pose of the world in the new one, (4, 4) [m].
        """
        return Pose(T_new_world @ self.root, self.balls, self.hinges)


class RootDescription(Model):
    """Position and orientation of a free segment: of the root in the world."""

    position: tuple[WorldCoordinate, WorldCoordinate, WorldCoordinate] = (0.0, 0.0, 0.0)
    """Position of the segment's origin in the world [m]; of another segment than the root, its
    displacement from rest in the parent's frame."""
    rotation_deg: Rotation = (0.0, 0.0, 0.0)
    """Rotation vector of the segment's frame [deg]."""


JointAngles = RootDescription | Angle | tuple[Angle, Angle] | Rotation
"""One angle of a hinge, two of a universal joint, or a rotation vector [deg]; the displacement of a
prismatic joint [m]; position and orientation of a free one."""


class PoseDescription(Model):
    """A pose in YAML; joints that it does not name are at rest."""

    root: RootDescription = RootDescription()
    """Position and orientation of the root in the world."""
    joints: dict[str, JointAngles] = Field(default_factory=dict)
    """By segment: one angle of a hinge, two of a universal joint, or a rotation vector [deg]; the
    displacement of a prismatic joint [m]; position and orientation of a free one."""
