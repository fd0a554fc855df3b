"""Templates as readable YAML: aligned rows, sections and comments."""

from __future__ import annotations

import json
from collections.abc import Mapping, Sequence

import numpy as np

from regkit.body.description import BodyDescription, SizeDescription
from regkit.body.rows import fields_row, key, number, row, word
from regkit.body.shape_parameters import ShapeParameters
from regkit.skeleton import PoseDescription, SegmentDescription
from regkit.skeleton.joints import (
    BallJoint,
    CouplingDescription,
    FixedJoint,
    FreeJoint,
    HingeJoint,
    Joint,
    PrismaticCouplingDescription,
    PrismaticJoint,
    UniversalJoint,
)
from regkit.skeleton.pose import JointAngles, RootDescription

_LETTERS = {
    tuple(float(number) for number in sign * axis): text + letter
    for sign, text in ((1.0, ""), (-1.0, "-"))
    for axis, letter in zip(np.eye(3), "xyz", strict=True)
}


_UPRIGHT = "In the first frame y points up and the front faces the camera."

_SHAPES = """\
Primitives of shape models; sigma is a standard deviation [m], and the surface lies at about two."""

_PARTS = "The parts, by their first segments; each has all that hangs on it but for other parts."

_SOCKETS = """\
How a part with joints of its own, such as a hand with fingers, takes a segment's place."""

_BESIDE = "The skin: vertices that follow the segments, in a file in the same folder."

_VARIED = (
    "The shape modes: displacements of the segments and the skin, in a file in the same folder."
)


def template_text(body: BodyDescription, opening: str, comments: Mapping[str, str]) -> str:
    """Returns the YAML of a template; lengths have four decimals [m] and angles one [deg].

    The mesh and the shape modes, if any, must be in the same folder.

    Args:
        body: The template.
        opening: Comment at the top.
        comments: Comments on the joints of segments, by the segment's name.
    """
    lines = [*comment_lines(opening), "", f"title: {json.dumps(body.title)}"]
    if body.sources:
        lines += ["", "sources:", *(f"  - {json.dumps(source)}" for source in body.sources)]
    lines += ["", f"size: {_size(body.size)}"]
    if body.upright:
        lines += ["", *comment_lines(_UPRIGHT), "upright: true"]
    lines += [
        "",
        "# Each segment's origin is its joint; `offset` is where that lies in the parent's frame.",
        "segments:",
    ]
    for name, segment in body.segments.items():
        lines += ["", f"  {key(name)}", *_segment(segment, comments.get(name, ""))]
    if body.stances:
        lines += [
            "",
            "# Likely poses of the first frame, in degrees; the rest pose is always tried.",
            "stances:",
        ]
    for name, pose in body.stances.items():
        lines += [f"  {key(name)}", *_stance(pose, body.segments)]
    if body.shapes:
        lines += ["", *comment_lines(_SHAPES), *shape_lines(body.shapes)]
    lines += _parts(body) + _sockets(body)
    if body.mesh is not None:
        lines += ["", *comment_lines(_BESIDE), f"mesh: {json.dumps(body.mesh.name)}"]
    if body.modes is not None:
        lines += ["", *comment_lines(_VARIED), f"modes: {json.dumps(body.modes.name)}"]
    return "\n".join(lines) + "\n"


def shape_lines(shapes: Mapping[str, Mapping[str, Sequence[ShapeParameters]]]) -> list[str]:
    """Returns the lines of ``shapes``: the primitives of each list, by segment."""
    lines = ["shapes:"]
    for listed, by_segment in shapes.items():
        lines.append(f"  {key(listed)} # {sum(map(len, by_segment.values()))} in all")
        for name, several in by_segment.items():
            lines.append(f"    {key(name)}")
            lines += [f"      - {one.yaml()}" for one in several]
    return lines


def _parts(body: BodyDescription) -> list[str]:
    lines = ["", *comment_lines(_PARTS), "parts:"] if body.parts else []
    for name, part in body.parts.items():
        lines.append(f"  {key(name)} {{root: {word(part.root)}, size: {part.size:.4f}}}")
    return lines


def _sockets(body: BodyDescription) -> list[str]:
    lines = ["", *comment_lines(_SOCKETS), "sockets:"] if body.sockets else []
    for name, socket in body.sockets.items():
        lines.append(f"  {key(name)}")
        if any(socket.offset):
            lines.append(f"    offset: {row(socket.offset)}")
        lines += [
            f"    rotation_deg: {row(socket.rotation_deg, 1)}",
            f"    joint: {_joint(socket.joint)}",
            f"    size: {socket.size:.4f}",
        ]
    return lines


def comment_lines(text: str, indent: str = "") -> list[str]:
    """Returns a text as the lines of a comment."""
    return [f"{indent}# {line}".rstrip() for line in text.strip().splitlines()]


def _size(size: SizeDescription) -> str:
    ends = ", ".join(f"{round(end, 4):g}" for end in size.range)
    return f"{{name: {word(size.name)}, value: {size.value:.4f}, range: [{ends}]}}"


def _stance(pose: PoseDescription, segments: Mapping[str, SegmentDescription]) -> list[str]:
    lines = []
    if pose.root != RootDescription():
        lines.append(f"    root: {_root(pose.root)}")
    lines.append("    joints:" if pose.joints else "    joints: {}")
    width = max((len(key(joint)) for joint in pose.joints), default=0)
    for joint, angles in pose.joints.items():
        lines.append(f"      {key(joint):<{width}} {_angles(angles, segments[joint].joint)}")
    return lines


def _angles(angles: JointAngles, joint: Joint | None) -> str:
    if isinstance(angles, RootDescription):
        return _root(angles)
    decimals = 4 if isinstance(joint, PrismaticJoint) else 1
    value = number(angles, decimals) if isinstance(angles, float) else row(angles, decimals)
    return value.strip()


def _root(root: RootDescription) -> str:
    return f"{{position: {row(root.position)}, rotation_deg: {row(root.rotation_deg, 1)}}}"


def _segment(segment: SegmentDescription, comment: str) -> list[str]:
    lines = comment_lines(comment, "    ")
    if segment.parent is not None:
        lines.append(f"    parent: {word(segment.parent)}")
    # What stands still is known better than a joint of a body: a root keeps more decimals.
    decimals, degrees = (4, 1) if segment.parent is not None else (6, 4)
    if segment.parent is not None or any(segment.offset):
        lines.append(f"    offset: {row(segment.offset, decimals)}")
    if any(segment.rotation_deg):
        lines.append(f"    rotation_deg: {row(segment.rotation_deg, degrees)}")
    if segment.optional:
        lines.append("    optional: true")
    lines.append(f"    joint: {_joint(segment.joint or FixedJoint())}")
    if segment.capsules:
        lines.append("    capsules:")
        lines += [f"      - {fields_row(one)}" for one in segment.capsules]
    if segment.markers:
        width = max(len(key(name)) for name in segment.markers)
        lines.append("    markers:")
        lines += [f"      {key(name):<{width}} {row(at)}" for name, at in segment.markers.items()]
    return lines


def _joint(joint: Joint) -> str:
    match joint:
        case FreeJoint() | FixedJoint():
            return f"{{type: {joint.type}}}"
        case HingeJoint():
            fields = [f"axis: {_axis(joint.axis)}"]
            if joint.limits_deg is not None:
                fields.append(f"limits_deg: {row(joint.limits_deg, 1)}")
            if joint.coupled is not None:
                fields.append(f"coupled: {_coupling(joint.coupled)}")
        case PrismaticJoint():
            fields = [f"axis: {_axis(joint.axis)}", f"limits: {row(joint.limits)}"]
            if joint.coupled is not None:
                fields.append(f"coupled: {_coupling(joint.coupled)}")
        case UniversalJoint():
            fields = [f"axes: [{', '.join(map(_axis, joint.axes))}]"]
            if joint.limits_deg is not None:
                ranges = ", ".join(row(limits, 1) for limits in joint.limits_deg)
                fields.append(f"limits_deg: [{ranges}]")
        case BallJoint():
            twist, swing = _axes_at_right_angles(joint)
            fields = [f"twist_axis: {twist}", f"swing_axis: {swing}"]
            fields.append(f"centre_deg: {row(joint.centre_deg, 1)}")
            if joint.swing_deg is not None:
                fields.append(f"swing_deg: {row(joint.swing_deg, 1)}")
            if joint.twist_deg is not None:
                fields.append(f"twist_deg: {row(joint.twist_deg, 1)}")
    return f"{{type: {joint.type}, {', '.join(fields)}}}"


def _coupling(coupling: CouplingDescription | PrismaticCouplingDescription) -> str:
    match coupling:
        case CouplingDescription(offset_deg=degrees):
            offset = f", offset_deg: {number(degrees, 1)}" if degrees else ""
        case PrismaticCouplingDescription(offset=metres):
            offset = f", offset: {number(metres, 4)}" if metres else ""
    return f"{{to: {word(coupling.to)}, ratio: {coupling.ratio:.4g}{offset}}}"


def _axes_at_right_angles(joint: BallJoint) -> tuple[str, str]:
    """Returns twist and swing axes, unrounded where rounding would destroy orthogonality."""
    axes = (joint.twist_axis, joint.swing_axis)
    twist, swing = np.round(axes, 4)
    if abs(float(twist @ swing)) < 1e-7:
        return _axis(joint.twist_axis), _axis(joint.swing_axis)
    first, second = (f"[{', '.join(map(repr, axis))}]" for axis in axes)
    return first, second


def _axis(axis: Sequence[float]) -> str:
    """Returns a letter for a coordinate axis, else the unit vector with four decimals."""
    return _LETTERS.get(tuple(axis)) or row(axis)
