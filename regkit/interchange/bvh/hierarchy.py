"""The hierarchy of a BVH file: parsing and writing its tree of joints."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np

from regkit.interchange.bvh.lines import Lines
from regkit.interchange.remarks import Remarks
from regkit.system.arrays import Array, read_only
from regkit.system.printable import plain_name

CHANNELS = (
    *("Xposition", "Yposition", "Zposition"),
    *("Xrotation", "Yrotation", "Zrotation"),
)
"""The channels of a joint: positions along, and rotations about, the axes x, y and z."""


@dataclass(frozen=True, eq=False)
class BvhJoint:
    """A joint of a BVH file.

    Attributes:
        name: Name of the joint.
        parent: Index of its parent, which comes before it; -1 for the root.
        offset: Position relative to its parent at rest, (3,) [m].
        channels: Its channels, some of ``CHANNELS``, in file order.
        ends: Position (3,) [m] of each end site in the joint's frame.
    """

    name: str
    parent: int
    offset: Array
    channels: tuple[str, ...]
    ends: tuple[Array, ...] = ()


def read_hierarchy(lines: Lines, scale: float, remarks: Remarks) -> tuple[BvhJoint, ...]:
    """Parses the joints of a file, parents before children, up to the end of the root.

    Args:
        lines: The lines of the file.
        scale: Metres per unit of the file.
        remarks: Takes what is assumed.

    Raises:
        DataError: If the hierarchy is invalid.
    """
    if lines.take("HIERARCHY").upper() != "HIERARCHY":
        raise lines.wrong("the first line must be HIERARCHY; this is not a BVH file")
    joints: list[BvhJoint] = []
    ends: list[list[Array]] = []
    names: set[str] = set()
    open_joints: list[int] = []
    while open_joints or not joints:
        line = lines.take("the rest of the joints")
        word, *rest = line.split(None, 1)
        match word.upper():
            case "}" if open_joints:
                open_joints.pop()
            case "END" | "ENDSITE" if open_joints:
                offset, _ = _attributes(lines, scale, "End Site")
                ends[open_joints[-1]].append(offset)
                _expect(lines, "}")
            case "ROOT" | "JOINT" if bool(open_joints) == (word.upper() == "JOINT"):
                name = _unique("".join(rest), names, len(joints), lines, remarks)
                parent = open_joints[-1] if open_joints else -1
                open_joints.append(len(joints))
                joints.append(BvhJoint(name, parent, *_attributes(lines, scale, word)))
                ends.append([])
            case _:
                wanted = "JOINT, End Site or }" if open_joints else "ROOT"
                raise lines.wrong(f"'{line[:40]}' where {wanted} is expected")
    if lines.ahead().upper().startswith("ROOT"):
        name = lines.take("MOTION")[4:44].strip()
        raise lines.wrong(f"'{name}' is a second ROOT; there must be exactly one")
    return tuple(replace(joint, ends=tuple(own)) for joint, own in zip(joints, ends, strict=True))


def _unique(name: str, names: set[str], number: int, lines: Lines, remarks: Remarks) -> str:
    """Returns a joint's name, or another if it is empty or taken."""
    given = plain_name(name.strip())
    name = given or f"joint_{number}"
    count = 1
    while name in names:
        count += 1
        name = f"{given or 'joint'}_{number if not given else count}"
    if name != given:
        remarks.add("joints without a name of their own get one", f"{given} -> {name}", lines.place)
    names.add(name)
    return name


def _expect(lines: Lines, wanted: str) -> None:
    line = lines.take(wanted)
    if line != wanted:
        raise lines.wrong(f"'{line[:40]}' where {wanted} is expected")


def _attributes(lines: Lines, scale: float, of: str) -> tuple[Array, tuple[str, ...]]:
    """Parses the opening brace of a joint, and returns its offset (3,) [m] and its channels."""
    _expect(lines, "{")
    offset, channels = None, None
    while True:
        word, *words = lines.ahead().split() or [""]
        match word.upper():
            case "OFFSET" if offset is None:
                lines.take("OFFSET")
                offset = scale * np.array(lines.numbers(" ".join(words), 3, "OFFSET"))
            case "CHANNELS" if channels is None:
                lines.take("CHANNELS")
                channels = _channels(lines, words)
            case _ if offset is None:
                raise lines.wrong(f"'{lines.take('OFFSET')[:40]}' where OFFSET is expected")
            case _:
                break
    if of.upper() not in ("ROOT", "JOINT") and channels:
        raise lines.wrong("an End Site has channels; it cannot move")
    return read_only(offset), channels or ()


def _channels(lines: Lines, words: list[str]) -> tuple[str, ...]:
    if not words or words[0] != str(len(words) - 1):
        raise lines.wrong(
            f"CHANNELS announces {words[0] if words else 'nothing'}, but "
            f"{max(0, len(words) - 1)} channels follow"
        )
    channels = tuple(name.capitalize() for name in words[1:])
    for name in channels:
        if name not in CHANNELS:
            raise lines.wrong(f"'{name}' is not a channel (there are: {', '.join(CHANNELS)})")
        if channels.count(name) > 1:
            raise lines.wrong(f"the channel {name} occurs twice; a joint has it at most once")
    return channels


def in_file_order(joints: Sequence[BvhJoint]) -> list[int]:
    """Returns the indices of the joints in file order, depth first."""
    order: list[int] = []
    children = children_of(joints)
    ahead = [0]
    while ahead:
        index = ahead.pop()
        order.append(index)
        ahead += reversed(children[index])
    return order


def children_of(joints: Sequence[BvhJoint]) -> list[list[int]]:
    """Returns the indices of each joint's children."""
    children: list[list[int]] = [[] for _ in joints]
    for index, joint in enumerate(joints):
        if joint.parent >= 0:
            children[joint.parent].append(index)
    return children


def hierarchy_text(joints: Sequence[BvhJoint], scale: float) -> list[str]:
    """Returns the lines of a hierarchy; ``scale`` is metres per unit of the file."""
    lines = ["HIERARCHY"]
    depths = [-1] * len(joints)
    depth = -1
    for index in in_file_order(joints):
        joint = joints[index]
        above = depths[joint.parent] if joint.parent >= 0 else -1
        lines += ["\t" * open_joint + "}" for open_joint in range(depth, above, -1)]
        depth = depths[index] = above + 1
        indent, within = "\t" * depth, "\t" * (depth + 1)
        lines += [f"{indent}{'JOINT' if depth else 'ROOT'} {joint.name}", f"{indent}{{"]
        lines.append(f"{within}OFFSET {row(joint.offset / scale)}")
        lines.append(" ".join([f"{within}CHANNELS {len(joint.channels)}", *joint.channels]))
        for end in joint.ends:
            lines += [f"{within}End Site", f"{within}{{"]
            lines += [f"{within}\tOFFSET {row(end / scale)}", f"{within}}}"]
    return [*lines, *("\t" * open_joint + "}" for open_joint in range(depth, -1, -1))]


def row(numbers: Array) -> str:
    """Returns numbers as text with ten significant digits."""
    return " ".join(f"{number + 0.0:.10g}" for number in numbers)
