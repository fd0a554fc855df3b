"""Retargeting of motion to the bones of a body by copying joint rotations."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass, replace

import numpy as np

from regkit.geometry.rotation import rotation_between
from regkit.geometry.skinned_mesh import SkinnedMesh
from regkit.system.arrays import Array
from regkit.system.errors import ConfigError
from regkit_synthesis.bodies.body_map import Between, BodyMap, bone_of
from regkit_synthesis.bodies.followers import Blended, Follower, Segment, Twisted
from regkit_synthesis.figure.figure import AIMS, FIGURE, leg_length
from regkit_synthesis.figure.names import instead_of
from regkit_synthesis.motion.motion import Motion, Rig, SourcePose

_LOOKS = 40
"""Number of times in a motion at which the lowest point of the skin is searched."""


@dataclass(frozen=True)
class Retarget:
    """Converts poses of a motion source to bone poses of a body.

    Attributes:
        mesh: The mesh; x to the body's left, y backward, z up.
        followers: Follower of each of the J bones; None for a bone that is fixed to its parent.
        scale: Scale of the motion of the hips.
        hips: Vector from the first bone's origin to the centre of the hips at rest, (3,) [m].
        lift: Vertical offset of the body [m].
    """

    mesh: SkinnedMesh
    followers: tuple[Follower | None, ...]
    scale: float
    hips: Array
    lift: float = 0.0

    @classmethod
    def of(cls, rig: Rig, mesh: SkinnedMesh, body: BodyMap) -> Retarget:
        """Returns the retargeting from a source to a body.

        Raises:
            ConfigError: If the map names a bone that the body lacks, or a joint that the source
                lacks.
        """
        places = {name: mark.position for name, mark in body.landmarks(mesh).items()}
        fit = _Fit(rig, mesh, places, straightening(places, rig.figure))
        followers: list[Follower | None] = [None] * len(mesh.labels)
        for label, followed in body.bones.items():
            bone = bone_of(mesh, label)
            followers[bone] = fit.follower(bone, followed)
        if followers[0] is None:
            followers[0] = fit.follower(0, "pelvis")
        scale = body.root_scale
        if scale == "leg":
            scale = leg_length(places) / leg_length(rig.figure)
        middle = (places["left_hip"] + places["right_hip"]) / 2
        return cls(mesh, tuple(followers), scale, middle - mesh.rest[0, :3, 3])

    def bone_poses(self, pose: SourcePose) -> Array:
        """Returns the bone poses ``T_ground_bone`` (J, 4, 4)."""
        turns = np.zeros((len(self.followers), 3, 3))
        for bone, follower in enumerate(self.followers):
            carried = turns[self.mesh.parents[bone]]
            turns[bone] = carried if follower is None else follower.turn(pose)
        middle = self.scale * pose.root + [0.0, 0.0, self.lift]
        return self.mesh.rotated(turns, middle - turns[0] @ self.hips)


def retargeted(
    motion: Motion, mesh: SkinnedMesh, body: BodyMap, *, grounded: bool = False
) -> Callable[[float], Array]:
    """Returns the function from a time [s] to bone poses ``T_ground_bone`` (J, 4, 4).

    Args:
        motion: The motion.
        mesh: The mesh; x to the body's left, y backward, z up.
        body: Map from its bones to the figure.
        grounded: Whether to shift the body vertically, by a constant, so that the lowest point of
            its skin over the whole motion is at z = 0. Otherwise the height of its hips is that of
            the source, scaled by the length of the legs.

    Raises:
        ConfigError: If the map names a bone that the body lacks, or a joint that the source lacks.
    """
    retarget = Retarget.of(motion.rig, mesh, body)
    if grounded:
        times = np.linspace(0.0, motion.duration, _LOOKS)
        skins = (mesh.posed(retarget.bone_poses(motion.at(time))) for time in times)
        retarget = replace(retarget, lift=-min(float(skin[:, 2].min()) for skin in skins))
    return lambda time: retarget.bone_poses(motion.at(time))


def straightening(body: Mapping[str, Array], source: Mapping[str, Array]) -> dict[str, Array]:
    """Returns the rotation (3, 3) of each segment from the body's rest to the source's rest.

    A limb segment rotates with its parent and then, by the smallest rotation, to the direction of
    the source's segment, so that an elbow bends about its own axis and a forearm does not twist.
    The trunk is unchanged. A foot rotates about the vertical only, since both soles are level.

    Args:
        body: Positions (3,) [m] at rest of the figure's joints that the body has.
        source: The same of the source.
    """
    turns: dict[str, Array] = {}
    for joint, parent in FIGURE.items():
        end = AIMS.get(joint)
        carried = turns[parent] if parent in AIMS else np.eye(3)
        if joint.endswith("_ankle"):
            turns[joint] = _aimed(joint, joint.replace("ankle", "foot"), body, source, _LEVEL)
        elif joint.endswith("_foot"):
            turns[joint] = turns[parent]
        elif end is None:
            turns[joint] = carried
        else:
            moved = {name: carried @ place for name, place in body.items()}
            turns[joint] = _aimed(joint, end, moved, source, np.ones(3)) @ carried
    return turns


_LEVEL = np.array([1.0, 1.0, 0.0])


def _aimed(
    joint: str, end: str, body: Mapping[str, Array], source: Mapping[str, Array], parts: Array
) -> Array:
    """Returns the rotation (3, 3) from the body's direction ``joint`` to ``end`` to the source's.

    Only the components where ``parts`` (3,) is one are used.
    """
    ways = [
        (places[end] - places[joint]) * parts
        for places in (body, source)
        if joint in places and end in places
    ]
    if len(ways) < 2 or min(np.linalg.norm(way) for way in ways) < 1e-6:
        return np.eye(3)
    return rotation_between(*ways)


@dataclass(frozen=True)
class _Fit:
    """A source and a body with matched rest poses.

    Attributes:
        rig: The source.
        mesh: The mesh of the body.
        places: Positions (3,) [m] of the figure's joints on the body at rest.
        straight: Rotation (3, 3) of each segment of the body to the source's direction.
    """

    rig: Rig
    mesh: SkinnedMesh
    places: Mapping[str, Array]
    straight: Mapping[str, Array]

    def follower(self, bone: int, followed: str | Between) -> Follower:
        """Returns the follower of a bone as its map defines it.

        Raises:
            ConfigError: If neither the figure nor the source has the joint.
        """
        if isinstance(followed, str):
            return self._segment(bone, followed)
        start, end = (self._segment(bone, joint) for joint in followed.between)
        if not followed.only_twist:
            return Blended(start, end, followed.share)
        along = self.mesh.rest[bone, :3, 1]
        if followed.between[1] in self.places:
            # About the way to the next joint, which therefore stays where it is.
            along = self.places[followed.between[1]] - self.mesh.rest[bone, :3, 3]
        return Twisted(start, end, followed.share, along / np.linalg.norm(along))

    def _segment(self, bone: int, joint: str) -> Segment:
        own = self.rig.moving(joint)
        if own is None:
            known = dict.fromkeys([*FIGURE, *self.rig.parents])
            raise ConfigError(
                f"bone '{self.mesh.labels[bone]}' follows '{joint}', which neither a figure nor "
                f"this source has{instead_of(joint, known)}"
            )
        return Segment(own, self.straight.get(joint, np.eye(3)))
