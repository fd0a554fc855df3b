"""Templates from URDF robots."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import numpy as np

from regkit.config.quantities import LARGEST_ANGLE
from regkit.geometry.rigid import rigid
from regkit.interchange.imported import MIN_LENGTH, Bone, ImportedSkeleton, ball, vector
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
from regkit.system.notes import note

SPREAD = (1.0, 1.0)
"""Range of the size relative to the robot's own; a robot has a fixed size."""


def urdf_template(
    robot: Urdf, path: Path, title: str, axes: Array, scale: float
) -> ImportedSkeleton:
    """Returns the template of a robot, with a segment and a marker for each link, of its name.

    The segment frames have the origins of the link frames, and are parallel at zero angles.

    Args:
        robot: The robot.
        path: The file.
        title: Title of the template.
        axes: ``R_body_root``, (3, 3).
        scale: Metres per unit of the file.

    Raises:
        DataError: If a shape is invalid, or the ratio of a coupling is too small.
    """
    names = list(robot.links)
    rotations = {names[0]: axes}
    bones = []
    for name, link in robot.links.items():
        joint = robot.joints.get(name)
        own: Joint = FreeJoint()
        offset, parent = np.zeros(3), -1
        if joint is not None:
            above = rotations[joint.parent]
            rotations[name] = above @ joint.origin[:3, :3]
            offset = scale * above @ joint.origin[:3, 3]
            parent = names.index(joint.parent)
            offsets = [
                rotations[name] @ other.origin[:3, 3]
                for other in robot.joints.values()
                if other.parent == name
            ]
            own = _joint(joint, rotations[name], offsets, robot)
        shapes = capsules_of(link, rigid(rotations[name], np.zeros(3)), scale)
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


def _joint(joint: UrdfJoint, rotation: Array, offsets: list[Array], robot: Urdf) -> Joint:
    if joint.kind == "fixed":
        return FixedJoint()
    if joint.kind == "spherical":
        return ball(next((one for one in offsets if np.linalg.norm(one) > MIN_LENGTH), None))
    limits = None if joint.limits is None else np.degrees(joint.limits)
    if limits is not None and np.abs(limits).max() > LARGEST_ANGLE:
        note(
            f"joint '{joint.name}' has a limit of {np.abs(limits).max() / 360.0:.3g} turns; it "
            f"gets {LARGEST_ANGLE / 360.0:g}",
            place=joint.place,
        )
        limits = np.clip(limits, -LARGEST_ANGLE, LARGEST_ANGLE)
    return HingeJoint(
        type="hinge",
        axis=vector(rotation @ joint.axis),
        limits_deg=None if limits is None else (float(limits[0]), float(limits[1])),
        coupled=None if joint.mimic is None else _coupling(joint, joint.mimic, robot),
    )


def _coupling(joint: UrdfJoint, mimic: Mimic, robot: Urdf) -> CouplingDescription:
    """Returns the coupling of a hinge.

    Raises:
        DataError: If its ratio, the product along a chain of couplings, is too small.
    """
    leader = next(other for other in robot.joints.values() if other.name == mimic.joint)
    if abs(mimic.ratio) < MIN_RATIO:
        raise DataError(
            f"joint '{joint.name}' follows '{leader.name}' with the ratio {mimic.ratio:g}, which "
            "is too small; make a joint that does not turn a fixed joint",
            place=joint.place,
        )
    return CouplingDescription(
        to=leader.child, ratio=mimic.ratio, offset_deg=float(np.degrees(mimic.offset))
    )
