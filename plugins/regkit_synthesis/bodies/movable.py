"""The interface of bodies that can be animated."""

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
    """A body with ground-truth joints.

    Attributes:
        mesh: The mesh at rest; x to the body's left, y backward, z up.
    """

    mesh: SkinnedMesh

    @property
    @abstractmethod
    def landmarks(self) -> Mapping[str, Landmark]:
        """Returns the joints with ground truth, by name."""

    @abstractmethod
    def moved_by(self, config: MotionConfig | GesturesConfig) -> Callable[[float], Array]:
        """Returns the function from a time [s] to bone poses ``T_ground_bone`` (J, 4, 4).

        Raises:
            ConfigError: If the motion does not fit this body.
        """


class BodyConfig(Model, ABC):
    """The YAML form of a body."""

    @abstractmethod
    def body(self) -> MovableBody:
        """Returns the body.

        Raises:
            RegkitError: If its file is missing or invalid, or its map names a bone that it lacks.
        """
