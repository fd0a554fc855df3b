"""Maps from the bones of a body to the joints of the figure."""

from __future__ import annotations

from typing import Literal

import numpy as np
from pydantic import Field, field_validator, model_validator

from regkit.config.model import Model
from regkit.config.quantities import Coordinate, Factor
from regkit.geometry.skinned_mesh import SkinnedMesh
from regkit.system.arrays import Array
from regkit.system.errors import ConfigError
from regkit_synthesis.bodies.landmarks import Landmark
from regkit_synthesis.figure.figure import check_joints
from regkit_synthesis.figure.map_files import read_map, shipped
from regkit_synthesis.figure.names import instead_of, meant


class Between(Model):
    """A bone with a rotation between those of two joints."""

    between: tuple[str, str]
    """The two joints; the first one is nearer to the pelvis."""

    share: float = Field(ge=0.0, le=1.0)
    """Fraction of the rotation from the first joint to the second."""

    only_twist: bool = False
    """Whether the bone follows the first joint, and only the twist of the second one about the
    bone, like a forearm and its hand."""


class Spot(Model):
    """A point on a bone."""

    bone: str
    """The bone; by default the point is its origin."""

    between: tuple[str, str] | None = None
    """Two bones; the point is the midpoint of their origins at rest."""

    along: Coordinate | None = None
    """Distance of the point from the bone's origin along the bone [m]."""

    crown: float | None = Field(default=None, ge=0.0, le=1.0)
    """Position of the point between the bone's origin (0) and the mesh's highest vertex (1)."""

    @model_validator(mode="after")
    def _one_way(self) -> Spot:
        if sum(way is not None for way in (self.between, self.along, self.crown)) > 1:
            raise ValueError("give one of between, along and crown")
        return self


class BodyMap(Model):
    """A map from the bones of a rigged body to the human figure.

    Bones that it does not name follow their parents rigidly.
    """

    title: str = ""
    """Description of the bodies that it is for."""

    joints: dict[str, str | Spot]
    """Positions of the figure's joints: the bone with its origin there, or a ``Spot``. They are the
    joints with ground truth, and define the directions of the limbs at rest."""

    bones: dict[str, str | Between]
    """The joint that each bone follows, of the figure or of a particular source, such as a
    finger."""

    root_scale: Literal["leg"] | Factor = "leg"
    """Scale of the motion of the hips; ``leg`` is the ratio of the leg lengths of body and
    source."""

    @field_validator("joints")
    @classmethod
    def _of_a_figure(cls, joints: dict[str, str | Spot]) -> dict[str, str | Spot]:
        check_joints(joints)
        missing = [joint for joint in _NEEDED if joint not in joints]
        if missing:
            raise ValueError(f"it must say where {', '.join(missing)} are")
        return joints

    def landmarks(self, mesh: SkinnedMesh) -> dict[str, Landmark]:
        """Returns the joints by name, as points on the bones of a mesh.

        Raises:
            ConfigError: If the mesh lacks a bone.
        """
        return {joint: _landmark(spot, mesh) for joint, spot in self.joints.items()}


_NEEDED = ("head", *(f"{s}_{j}" for s in ("left", "right") for j in ("hip", "knee", "ankle")))
"""The joints that every map must have, for the orientation and the leg length of a body."""


def bone_of(mesh: SkinnedMesh, label: str) -> int:
    """Returns the index of the bone named ``label`` in any namespace.

    Raises:
        ConfigError: If there is no such bone.
    """
    found = meant(label, mesh.labels)
    if found is None:
        raise ConfigError(f"the body has no bone '{label}'{instead_of(label, mesh.labels)}")
    return mesh.labels.index(found)


def body_map(name: str) -> BodyMap:
    """Returns the shipped map of a name, or the map in a YAML file.

    Raises:
        RegkitError: If there is no such map, or it is invalid.
    """
    return read_map(BodyMap, "bodies", name)


def fitting_body_map(mesh: SkinnedMesh) -> BodyMap:
    """Returns the first shipped map whose bones a mesh has.

    Raises:
        ConfigError: If no map fits.
    """
    for name in shipped("bodies"):
        found = body_map(name)
        if all(meant(label, mesh.labels) is not None for label in found.bones):
            return found
    raise ConfigError(
        f"none of the maps that ship ({', '.join(shipped('bodies'))}) is for a body with the bones "
        f"{', '.join(mesh.labels)}; name a file of your own as its map"
    )


def _landmark(spot: str | Spot, mesh: SkinnedMesh) -> Landmark:
    if isinstance(spot, str):
        spot = Spot(bone=spot)
    bone = bone_of(mesh, spot.bone)
    start = _start(mesh, spot.bone)
    if spot.between is not None:
        first, second = spot.between
        return Landmark(bone, (_start(mesh, first) + _start(mesh, second)) / 2)
    if spot.along is not None:
        return Landmark(bone, start + spot.along * np.asarray(mesh.rest[bone, :3, 1]))
    if spot.crown is not None:
        top = mesh.vertices[np.argmax(mesh.vertices[:, 2])]
        return Landmark(bone, (1.0 - spot.crown) * start + spot.crown * top)
    return Landmark(bone, start)


def _start(mesh: SkinnedMesh, label: str) -> Array:
    """Returns the origin (3,) [m] of a bone at rest."""
    return np.array(mesh.rest[bone_of(mesh, label), :3, 3])
