"""Rigged human bodies, and their YAML form."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from typing import Annotated, Literal

from pydantic import Field

from regkit.config.model import InputPath
from regkit.geometry.skinned_mesh import SkinnedMesh
from regkit.interchange.gltf.file import SUFFIXES
from regkit.interchange.gltf.gltf import RiggedBody
from regkit.system.arrays import Array
from regkit.system.errors import ConfigError, DataError, RegkitError
from regkit_synthesis import assets
from regkit_synthesis.bodies.body_files import read_npz_body, turned_mesh
from regkit_synthesis.bodies.body_map import BodyMap, body_map, bone_of, fitting_body_map
from regkit_synthesis.bodies.hand import ShippedHand
from regkit_synthesis.bodies.handed import HandedBody
from regkit_synthesis.bodies.landmarks import Landmark
from regkit_synthesis.bodies.movable import BodyConfig, MovableBody
from regkit_synthesis.bodies.objects import BoxObject, CylinderObject
from regkit_synthesis.bodies.retarget import retargeted
from regkit_synthesis.figure.figure import figure_axes
from regkit_synthesis.figure.map_files import MapName
from regkit_synthesis.hands.config import GesturesConfig, HandsConfig
from regkit_synthesis.motion.config import MotionConfig
from regkit_synthesis.motion.motion import Motion


@dataclass(frozen=True)
class HumanBody(MovableBody):
    """A body with the bones of a human figure.

    Attributes:
        map: Map from its bones to the joints of the figure.
    """

    map: BodyMap

    @classmethod
    def of(cls, mesh: SkinnedMesh, map: BodyMap) -> HumanBody:
        """Returns the body of a mesh with any axis convention, inferred from its hips and head.

        Raises:
            ConfigError: If the mesh lacks a bone that the map names.
            DataError: If the mesh is not upright along one of its axes.
        """
        for label in map.bones:
            bone_of(mesh, label)
        places = {name: mark.position for name, mark in map.landmarks(mesh).items()}
        return cls(turned_mesh(mesh, figure_axes(places)), map)

    @property
    def landmarks(self) -> dict[str, Landmark]:
        """Returns the joints with ground truth, by name."""
        return self.map.landmarks(self.mesh)

    def moved_by(self, config: MotionConfig | GesturesConfig) -> Callable[[float], Array]:
        """Returns the function from a time [s] to bone poses ``T_ground_bone`` (J, 4, 4).

        Raises:
            ConfigError: If it is a motion of hands, or the map names a joint that the source of the
                motion lacks.
        """
        if isinstance(config, GesturesConfig):
            raise ConfigError("gestures are a motion of a hand, and this body is a person")
        return self.moved(config.motion(), grounded=config.grounded)

    def moved(self, motion: Motion, *, grounded: bool = True) -> Callable[[float], Array]:
        """The bone poses ``T_ground_bone`` (J, 4, 4) at a time [s] of a motion.

        Args:
            motion: The motion.
            grounded: Whether the body is set on the ground; see ``retargeted``.

        Raises:
            ConfigError: If the map names a joint that the source of the motion lacks.
        """
        return retargeted(motion, self.mesh, self.map, grounded=grounded)


def human_landmarks(mesh: SkinnedMesh) -> dict[str, Landmark]:
    """Returns the 20 joints of a human body with the CMU rig; left is the person's left."""
    return body_map("anny_cmu").landmarks(mesh)


BodyName = Literal["average", "small", "tall"]

_SHIPPED: Mapping[BodyName, Callable[[], SkinnedMesh]] = {
    "average": assets.average_human,
    "small": assets.small_human,
    "tall": assets.tall_human,
}


_HANDS: Mapping[BodyName, Callable[[], SkinnedMesh]] = {
    "average": assets.average_hand,
    "small": assets.small_hand,
    "tall": assets.tall_hand,
}
"""The right hand of each body, whose vertices are some of the body's."""


class ShippedBody(BodyConfig):
    """A shipped body."""

    kind: Literal["shipped"] = "shipped"

    name: BodyName = "average"
    """The body of average proportions, a small or a tall one; all are anny's with the CMU rig."""

    hands: HandsConfig | None = None
    """What the fingers do; by default they do not move, and have no joints with ground truth."""

    def body(self) -> MovableBody:
        """Returns the body."""
        human = HumanBody(_SHIPPED[self.name](), body_map("anny_cmu"))
        if self.hands is None:
            return human
        return HandedBody.of(human, _HANDS[self.name](), self.hands)


class BodyFile(BodyConfig):
    """A rigged body in a file."""

    kind: Literal["file"] = "file"

    path: InputPath
    """An ``.npz`` mesh file, anny's own export (``.npz``), or a rigged glTF (``.glb``,
    ``.gltf``)."""

    shape: int = Field(default=0, ge=0)
    """Index of the shape, if the file has several."""

    map: MapName | None = None
    """Map from its bones to the figure: the name of a shipped map, or a YAML file; by default the
    first shipped map that fits."""

    def body(self) -> HumanBody:
        """Returns the body."""
        mesh = self._mesh()
        try:
            found = fitting_body_map(mesh) if self.map is None else body_map(self.map)
            return HumanBody.of(mesh, found)
        except RegkitError as error:
            place = f"{self.path} with the map {self.map}" if self.map else str(self.path)
            raise error.at(place) from None

    def _mesh(self) -> SkinnedMesh:
        ending = self.path.suffix.lower()
        if ending == ".npz":
            return read_npz_body(self.path, self.shape)
        if ending not in SUFFIXES:
            raise DataError(
                f"a body must be .npz, .glb or .gltf, not '{ending}'", place=str(self.path)
            )
        if self.shape:
            raise ConfigError("a glTF holds one shape, 0", place=str(self.path))
        return RiggedBody.read(self.path).mesh


AnyBody = Annotated[
    ShippedBody | BodyFile | ShippedHand | BoxObject | CylinderObject, Field(discriminator="kind")
]
"""A body, by its ``kind``."""
