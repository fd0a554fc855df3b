"""Which bones of a body follow which joints of a figure, and where its joints are."""

from __future__ import annotations

from typing import Literal

import numpy as np
from pydantic import Field, field_validator, model_validator

from regkit.config.model import Model
from regkit.geometry.skinned_mesh import SkinnedMesh
from regkit.system.arrays import Array
from regkit.system.errors import ConfigError
from regkit_synthesis.bodies.landmarks import Landmark
from regkit_synthesis.figure.figure import check_joints
from regkit_synthesis.figure.map_files import read_map, shipped
from regkit_synthesis.figure.names import instead_of, meant


class Between(Model):
    """A bone that turns as something between two joints."""

    between: tuple[str, str]
    """The two joints, of which the first is nearer to the pelvis."""

    share: float = Field(ge=0.0, le=1.0)
    """How far the bone is turned from the first one towards the second."""

    only_twist: bool = False
    """Whether the bone goes with the first joint, and takes from the second one only its twist
    about the way to it: a forearm does so with the hand."""


class Spot(Model):
    """A point that a bone carries."""

    bone: str
    """The bone; without anything else, the point is where it starts."""

    between: tuple[str, str] | None = None
    """Two other bones, between whose starts the point lies at rest."""

    along: float | None = None
    """How far the point lies from the bone's start along the bone [m]."""

    crown: float | None = Field(default=None, ge=0.0, le=1.0)
    """How far the point lies from the bone's start on the way to the mesh's highest vertex, as a
    share of it."""

    @model_validator(mode="after")
    def _one_way(self) -> Spot:
        if sum(way is not None for way in (self.between, self.along, self.crown)) > 1:
            raise ValueError("give one of between, along and crown")
        return self


class BodyMap(Model):
    """How a rigged body is a human figure.

    Bones that are not named follow their parents rigidly.
    """

    title: str = ""
    """Which bodies it is for."""

    joints: dict[str, str | Spot]
    """Where the figure's joints are: the bone that starts there, or a ``Spot``. They are the points
    whose truth is known, and tell how the limbs lie at rest."""

    bones: dict[str, str | Between]
    """The joint that each bone turns with. It may be one of a figure, or one that only some source
    has, such as a finger."""

    root_scale: Literal["leg"] | float = "leg"
    """What the way of the hips is multiplied by; ``leg`` is the length of this body's legs over
    that of the source's."""

    @field_validator("joints")
    @classmethod
    def _of_a_figure(cls, joints: dict[str, str | Spot]) -> dict[str, str | Spot]:
        check_joints(joints)
        missing = [joint for joint in _NEEDED if joint not in joints]
        if missing:
            raise ValueError(f"it must say where {', '.join(missing)} are")
        return joints

    def landmarks(self, mesh: SkinnedMesh) -> dict[str, Landmark]:
        """The joints by name, as points that the mesh's bones carry.

        Raises:
            ConfigError: If the mesh lacks a bone.
        """
        return {joint: _landmark(spot, mesh) for joint, spot in self.joints.items()}


_NEEDED = ("head", *(f"{s}_{j}" for s in ("left", "right") for j in ("hip", "knee", "ankle")))
"""The joints without which nothing says how a body stands and how long its legs are."""


def bone_of(mesh: SkinnedMesh, label: str) -> int:
    """The index of the bone named ``label``, whatever its namespace.

    Raises:
        ConfigError: If there is none.
    """
    found = meant(label, mesh.labels)
    if found is None:
        raise ConfigError(f"the body has no bone '{label}'{instead_of(label, mesh.labels)}")
    return mesh.labels.index(found)


def body_map(name: str) -> BodyMap:
    """The map of this name that ships, or the one in this YAML file.

    Raises:
        RegkitError: If there is none, or it is wrong.
    """
    return read_map(BodyMap, "bodies", name)


def fitting_body_map(mesh: SkinnedMesh) -> BodyMap:
    """The first map that ships whose bones a mesh has.

    Raises:
        ConfigError: If there is none.
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
    """Where a bone starts at rest (3,) [m]."""
    return np.array(mesh.rest[bone_of(mesh, label), :3, 3])
