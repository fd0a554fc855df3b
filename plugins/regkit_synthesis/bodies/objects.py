"""Rigid objects, and their YAML form."""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Callable
from dataclasses import dataclass
from typing import Literal

import numpy as np

from regkit.config.quantities import Length
from regkit.geometry.skinned_mesh import SkinnedMesh
from regkit.system.arrays import Array, Indices
from regkit.system.errors import ConfigError
from regkit_synthesis.bodies.landmarks import Landmark
from regkit_synthesis.bodies.movable import BodyConfig, MovableBody
from regkit_synthesis.boxes import boxes
from regkit_synthesis.hands.config import GesturesConfig
from regkit_synthesis.motion.config import MotionConfig

_AROUND = 48
"""Number of vertices around a cylinder."""


@dataclass(frozen=True)
class RigidBody(MovableBody):
    """An object of one bone, with its centre as the origin.

    Attributes:
        marks: Points with ground truth by name, (3,) [m].
    """

    marks: dict[str, Array]

    @classmethod
    def of(cls, vertices: Array, faces: Indices, marks: dict[str, Array]) -> RigidBody:
        """Returns the object of a mesh.

        Args:
            vertices: Vertices about the object's centre, (V, 3) [m].
            faces: Vertex indices of the triangles, (F, 3).
            marks: Points with ground truth by name, (3,) [m].
        """
        count = len(vertices)
        mesh = SkinnedMesh(
            vertices=vertices,
            faces=faces,
            labels=("object",),
            parents=np.array([-1]),
            rest=np.eye(4)[None],
            indices=np.zeros((count, 1), dtype=np.intp),
            weights=np.ones((count, 1)),
        )
        return cls(mesh, marks)

    @property
    def landmarks(self) -> dict[str, Landmark]:
        """Returns the points with ground truth, by name."""
        return {name: Landmark(0, place) for name, place in self.marks.items()}

    def moved_by(self, config: MotionConfig | GesturesConfig) -> Callable[[float], Array]:
        """Refuses any motion.

        Raises:
            ConfigError: Always.
        """
        raise ConfigError("a rigid object has no motion of its own; give it a course")


class RigidConfig(BodyConfig, ABC):
    """The YAML form of a rigid object."""

    @abstractmethod
    def body(self) -> RigidBody:
        """Returns the object."""


class BoxObject(RigidConfig):
    """A box, with the truth of its centre and of the middle of each face."""

    kind: Literal["box"] = "box"

    sides: tuple[Length, Length, Length]
    """Lengths to the right of the image, away from the camera and up [m]."""

    def body(self) -> RigidBody:
        """Returns the box."""
        half = 0.5 * np.array(self.sides)
        vertices, faces = boxes(np.array([[-half, half]]))
        names = ("left", "right", "front", "back", "bottom", "top")
        middles = [sign * half * np.eye(3)[axis] for axis in range(3) for sign in (-1.0, 1.0)]
        marks = dict(zip(names, middles, strict=True))
        return RigidBody.of(vertices, faces, {"centre": np.zeros(3), **marks})


class CylinderObject(RigidConfig):
    """An upright cylinder, such as a can, with the truth of its centre and of both ends."""

    kind: Literal["cylinder"] = "cylinder"

    radius: Length
    """Radius [m]."""
    height: Length
    """Height [m]."""

    def body(self) -> RigidBody:
        """Returns the cylinder."""
        angles = 2.0 * np.pi * np.arange(_AROUND) / _AROUND
        ring = self.radius * np.column_stack([np.cos(angles), np.sin(angles), np.zeros(_AROUND)])
        top = np.array([0.0, 0.0, 0.5 * self.height])
        vertices = np.concatenate([ring - top, ring + top, [-top, top]])
        one = np.arange(_AROUND)
        other = np.roll(one, -1)
        faces = np.concatenate([
            np.column_stack([one, other, other + _AROUND]),
            np.column_stack([one, other + _AROUND, one + _AROUND]),
            np.column_stack([other, one, np.full(_AROUND, 2 * _AROUND)]),
            np.column_stack([one + _AROUND, other + _AROUND, np.full(_AROUND, 2 * _AROUND + 1)]),
        ])  # fmt: skip
        return RigidBody.of(vertices, faces, {"centre": np.zeros(3), "bottom": -top, "top": top})
