"""Templates from URDF robots."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from pathlib import Path

import numpy as np

from regkit.geometry.rigid import rigid
from regkit.interchange.bones import MIN_LENGTH, Bone, ball, check_count, origins_of, vector
from regkit.interchange.imported import ImportedSkeleton
from regkit.interchange.remarks import Remarks
from regkit.interchange.urdf.joints import Mimic, UrdfJoint
from regkit.interchange.urdf.link_surface import LinkSurfaces
from regkit.interchange.urdf.mesh_files import MeshFiles
from regkit.interchange.urdf.shapes import LinkShapes
from regkit.interchange.urdf.skin import robot_skin
from regkit.interchange.urdf.urdf import Urdf
from regkit.skeleton.joints import (
    CouplingDescription,
    FixedJoint,
    FreeJoint,
    HingeJoint,
    Joint,
    PrismaticCouplingDescription,
    PrismaticJoint,
)
from regkit.system.arrays import Array

SPREAD = (1.0, 1.0)
"""Range of the size relative to the robot's own; a robot has a fixed size."""


def urdf_template(
    robot: Urdf, path: Path, title: str, axes: Array, scale: float, packages: Sequence[Path] = ()
) -> ImportedSkeleton:
    """Returns the template of a robot, with a segment and a marker for each link, of its name.

    The segment frames have the origins of the link frames, and are parallel at zero angles.

    Args:
        robot: The robot.
        path: The file.
        title: Title of the template.
        axes: ``R_body_file``, (3, 3).
        scale: Metres per unit of the file.
        packages: Folders in which the packages of meshes are looked for first.

    Raises:
        DataError: If there are too many links, or a shape is invalid.
    """
    check_count(len(robot.links), path)
    names = list(robot.links)
    index_of = {name: index for index, name in enumerate(names)}
    rotations = {names[0]: axes @ robot.axes}
    for name, joint in robot.joints.items():
        rotations[name] = rotations[joint.parent] @ joint.origin[:3, :3]
    offsets: dict[str, list[Array]] = {name: [] for name in names}
    for joint in robot.joints.values():
        offsets[joint.parent].append(rotations[joint.parent] @ joint.origin[:3, 3])
    remarks = Remarks()
    surfaces = LinkSurfaces(MeshFiles(path.resolve().parent, packages), remarks)
    shapes = LinkShapes(surfaces, remarks)
    bones, seen = [], {}
    for name, link in robot.links.items():
        found = robot.joints.get(name)
        T_bone_link = rigid(rotations[name], np.zeros(3))
        capsules = shapes.capsules(link, T_bone_link, scale)
        seen[name] = surfaces.triangles(link, T_bone_link, scale)
        bones.append(
            Bone(
                name=name,
                parent=-1 if found is None else index_of[found.parent],
                offset=np.zeros(3)
                if found is None
                else scale * rotations[found.parent] @ found.origin[:3, 3],
                joint=FreeJoint()
                if found is None
                else _joint(found, rotations[name], offsets[name], robot, scale),
                capsules=capsules if capsules or not (link.collision or link.visual) else None,
                markers={name: np.zeros(3)},
                comment="" if found is None else f"Joint '{found.name}', {found.kind}.",
            )
        )
    remarks.tell()
    if not any(bone.capsules for bone in bones):
        bones = [replace(bone, capsules=None) for bone in bones]
    imported = ImportedSkeleton.of(bones, path, title, spread=SPREAD)
    parents = [bone.parent for bone in bones]
    return replace(imported, skin=robot_skin(names, parents, origins_of(bones), seen))


def _joint(
    joint: UrdfJoint, rotation: Array, offsets: list[Array], robot: Urdf, scale: float
) -> Joint:
    if joint.kind == "fixed":
        return FixedJoint()
    if joint.kind == "spherical":
        return ball(next((one for one in offsets if np.linalg.norm(one) > MIN_LENGTH), None))
    if joint.kind == "prismatic" and joint.limits is not None:
        low, high = joint.limits
        return PrismaticJoint(
            type="prismatic",
            axis=vector(rotation @ joint.axis),
            limits=(scale * low, scale * high),
            coupled=None if joint.mimic is None else _slide(joint.mimic, robot, scale),
        )
    limits = None if joint.limits is None else np.degrees(joint.limits)
    return HingeJoint(
        type="hinge",
        axis=vector(rotation @ joint.axis),
        limits_deg=None if limits is None else (float(limits[0]), float(limits[1])),
        coupled=None if joint.mimic is None else _coupling(joint.mimic, robot),
    )


def _coupling(mimic: Mimic, robot: Urdf) -> CouplingDescription:
    """Returns the coupling of a hinge."""
    return CouplingDescription(
        to=_leader(mimic, robot), ratio=mimic.ratio, offset_deg=float(np.degrees(mimic.offset))
    )


def _slide(mimic: Mimic, robot: Urdf, scale: float) -> PrismaticCouplingDescription:
    """Returns the coupling of a prismatic joint."""
    return PrismaticCouplingDescription(
        to=_leader(mimic, robot), ratio=mimic.ratio, offset=scale * mimic.offset
    )


def _leader(mimic: Mimic, robot: Urdf) -> str:
    """Returns the link that the leading joint moves."""
    return next(joint.child for joint in robot.joints.values() if joint.name == mimic.joint)
