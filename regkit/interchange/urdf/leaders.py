"""The leaders of coupled joints of a URDF file."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace

from regkit.config.model import did_you_mean
from regkit.interchange.remarks import Remarks
from regkit.interchange.urdf.joints import AXIAL, HINGES, Mimic, UrdfJoint
from regkit.skeleton.joints import MIN_RATIO
from regkit.system.errors import DataError


def with_leaders(joints: Mapping[str, UrdfJoint], remarks: Remarks) -> dict[str, UrdfJoint]:
    """Returns the joints with chains of couplings resolved to independent leaders.

    A joint that follows none of its own kind, a hinge or a prismatic joint, moves by itself, with a
    remark.

    Args:
        joints: Joints by the name of their child link.
        remarks: Takes what is passed over.

    Raises:
        DataError: If a joint follows itself.
    """
    child_of = {joint.name: child for child, joint in joints.items()}
    by_name = {name: joints[child] for name, child in child_of.items()}
    own = {child: _with_leader(joint, by_name, remarks) for child, joint in joints.items()}
    led = {}
    for child, joint in joints.items():
        mimic, seen = own[child].mimic, [joint.name]
        while mimic is not None and (above := own[child_of[mimic.joint]].mimic) is not None:
            if mimic.joint in seen:
                raise DataError(
                    f"joint '{joint.name}' follows itself ({' -> '.join([*seen, mimic.joint])})",
                    place=joint.place,
                )
            seen.append(mimic.joint)
            # a = r b + o and b = s c + p give a = r s c + (r p + o).
            offset = mimic.ratio * above.offset + mimic.offset
            mimic = Mimic(above.joint, mimic.ratio * above.ratio, offset)
        if mimic is not None and abs(mimic.ratio) < MIN_RATIO:
            remarks.add(
                "joints move by themselves, because what they follow hardly moves them",
                f"{joint.name}: {mimic.ratio:g}",
                joint.place,
            )
            mimic = None
        led[child] = replace(joint, mimic=mimic)
    return led


def _with_leader(joint: UrdfJoint, joints: Mapping[str, UrdfJoint], remarks: Remarks) -> UrdfJoint:
    """Returns a joint, without its coupling if the leader is not a joint of its kind."""
    if joint.mimic is None:
        return joint
    leader = joints.get(joint.mimic.joint)
    turns = joint.kind in HINGES
    if leader is not None and leader.kind in AXIAL and (leader.kind in HINGES) == turns:
        return joint
    kind = "no joint" if leader is None else leader.kind
    hint = did_you_mean(joint.mimic.joint, list(joints)) if leader is None else ""
    remarks.add(
        "joints move by themselves, because what they follow is not "
        + ("a hinge" if turns else "a prismatic joint"),
        f"{joint.name} follows '{joint.mimic.joint}', which is {kind}{hint}",
        joint.place,
    )
    return replace(joint, mimic=None)
