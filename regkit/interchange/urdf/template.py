"""The links of a URDF as a template."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import numpy as np

from regkit.geometry.rigid import rigid
from regkit.interchange.imported import SHORTEST, Bone, ImportedSkeleton, ball, vector
from regkit.interchange.urdf.joints import Mimic, UrdfJoint
from regkit.interchange.urdf.shapes import capsules_of
from regkit.interchange.urdf.urdf import Urdf
from regkit.skeleton.joints import (
    MIN_RATIO,
    CouplingDescription,
    FixedJoint,
    FreeJoint,
    HingeJoint,
    Joint,
)
from regkit.system.arrays import Array
from regkit.system.errors import DataError

SPREAD = (1.0, 1.0)
"""A robot has one size."""


def urdf_template(
    robot: Urdf, path: Path, title: str, axes: Array, scale: float
) -> ImportedSkeleton:
    """The skeleton of a robot: a segment for each link, called as it, and a marker at its origin.

    The segments' frames are those of the links at zero angles, turned so that they are parallel.

    Args:
        robot: The file's content.
        path: The file.
        title: What it is, in a line.
        axes: ``R_body_root``, (3, 3).
        scale: Metres per unit of the file.

    Raises:
        DataError: If a shape is wrong, or a joint hardly follows another.
    """
    names = list(robot.links)
    turns = {names[0]: axes}
    bones = []
    for name, link in robot.links.items():
        joint = robot.joints.get(name)
        own: Joint = FreeJoint()
        offset, parent = np.zeros(3), -1
        if joint is not None:
            above = turns[joint.parent]
            turns[name] = above @ joint.origin[:3, :3]
            offset = scale * above @ joint.origin[:3, 3]
            parent = names.index(joint.parent)
            ways = [
                turns[name] @ other.origin[:3, 3]
                for other in robot.joints.values()
                if other.parent == name
            ]
            own = _joint(joint, turns[name], ways, robot)
        shapes = capsules_of(link, rigid(turns[name], np.zeros(3)), scale)
        bones.append(
            Bone(
                name=name,
                parent=parent,
                offset=offset,
                joint=own,
                capsules=shapes if shapes or not link.shapes else None,
                markers={name: np.zeros(3)},
                comment="" if joint is None else f"Joint '{joint.name}', {joint.kind}.",
            )
        )
    if not any(bone.capsules for bone in bones):
        bones = [replace(bone, capsules=None) for bone in bones]
    return ImportedSkeleton.of(bones, path, title, spread=SPREAD)


def _joint(joint: UrdfJoint, turn: Array, ways: list[Array], robot: Urdf) -> Joint:
    if joint.kind == "fixed":
        return FixedJoint()
    if joint.kind == "spherical":
        return ball(next((way for way in ways if np.linalg.norm(way) > SHORTEST), None))
    limits = None if joint.limits is None else np.degrees(joint.limits)
    return HingeJoint(
        type="hinge",
        axis=vector(turn @ joint.axis),
        limits_deg=None if limits is None else (float(limits[0]), float(limits[1])),
        coupled=None if joint.mimic is None else _coupling(joint, joint.mimic, robot),
    )


def _coupling(joint: UrdfJoint, mimic: Mimic, robot: Urdf) -> CouplingDescription:
    """How a hinge follows another.

    Raises:
        DataError: If it hardly turns with it, over others that follow each other.
    """
    leader = next(other for other in robot.joints.values() if other.name == mimic.joint)
    if abs(mimic.ratio) < MIN_RATIO:
        raise DataError(
            f"joint '{joint.name}' turns by {mimic.ratio:g} with '{leader.name}'; one that does "
            "not turn must be fixed",
            place=joint.place,
        )
    return CouplingDescription(
        to=leader.child, ratio=mimic.ratio, offset_deg=float(np.degrees(mimic.offset))
    )
