"""Mirror images of bodies: a left hand is a right one in the mirror."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass, replace

import numpy as np

from regkit.geometry.skinned_mesh import SkinnedMesh
from regkit.system.arrays import Array
from regkit_synthesis.bodies.landmarks import Landmark
from regkit_synthesis.bodies.movable import MovableBody
from regkit_synthesis.hands.config import GesturesConfig
from regkit_synthesis.motion.config import MotionConfig

_MIRROR = np.diag([-1.0, 1.0, 1.0, 1.0])
"""Exchanges left and right; points and bone poses T become M T M."""


@dataclass(frozen=True)
class MirroredBody(MovableBody):
    """A body and its motion with left and right exchanged.

    Attributes:
        original: The body on the other side of the mirror.
    """

    original: MovableBody

    @classmethod
    def of(cls, original: MovableBody) -> MirroredBody:
        """Returns the mirror image of a body."""
        return cls(mirrored_mesh(original.mesh), original)

    @property
    def landmarks(self) -> Mapping[str, Landmark]:
        """Returns the joints with ground truth, by name."""
        return {
            name: replace(mark, position=_MIRROR[:3, :3] @ mark.position)
            for name, mark in self.original.landmarks.items()
        }

    def moved_by(self, config: MotionConfig | GesturesConfig) -> Callable[[float], Array]:
        """Returns the function from a time [s] to bone poses ``T_ground_bone`` (J, 4, 4).

        Raises:
            ConfigError: If the motion does not fit this body.
        """
        poses = self.original.moved_by(config)
        return lambda time: np.asarray(_MIRROR @ poses(time) @ _MIRROR)


def mirrored_mesh(mesh: SkinnedMesh) -> SkinnedMesh:
    """Returns the mirror image of a mesh, whose bones of the right become those of the left."""
    return replace(
        mesh,
        vertices=mesh.vertices @ _MIRROR[:3, :3],
        faces=mesh.faces[:, ::-1],
        labels=tuple(label.replace(".R", ".L") for label in mesh.labels),
        rest=_MIRROR @ mesh.rest @ _MIRROR,
    )
