"""A body that can be moved, whatever it is."""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Callable, Mapping
from dataclasses import dataclass

from regkit.config.model import Model
from regkit.geometry.skinned_mesh import SkinnedMesh
from regkit.system.arrays import Array
from regkit_synthesis.bodies.landmarks import Landmark
from regkit_synthesis.hands.config import GesturesConfig
from regkit_synthesis.motion.config import MotionConfig


@dataclass(frozen=True)
class MovableBody(ABC):
    """A body with joints whose truth is known.

    Attributes:
        mesh: The body at rest; x to its left, y backward, z up.
    """

    mesh: SkinnedMesh

    @property
    @abstractmethod
    def landmarks(self) -> Mapping[str, Landmark]:
        """The joints whose truth is known, by name."""

    @abstractmethod
    def moved_by(self, config: MotionConfig | GesturesConfig) -> Callable[[float], Array]:
        """The bone poses ``T_ground_bone`` (J, 4, 4) at a time [s] of a motion.

        Raises:
            ConfigError: If this body cannot move so.
        """


class BodyConfig(Model, ABC):
    """A body that is to be moved."""

    @abstractmethod
    def body(self) -> MovableBody:
        """The body.

        Raises:
            RegkitError: If its file is missing or wrong, or its map names a bone that it lacks.
        """
