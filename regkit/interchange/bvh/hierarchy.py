"""The first half of a BVH file: its tree of joints, as text and as data."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np

from regkit.interchange.bvh.lines import Lines
from regkit.system.arrays import Array, read_only

CHANNELS = (
    *("Xposition", "Yposition", "Zposition"),
    *("Xrotation", "Yrotation", "Zrotation"),
)
"""What a joint may do; positions along, and rotations about, the axes x, y and z."""


@dataclass(frozen=True, eq=False)
class BvhJoint:
    """A joint of a BVH file.

    Attributes:
        name: Its name.
        parent: Index of its parent, which comes before it; -1 for the root.
        offset: (3,) where it lies in its parent's frame at rest [m].
        channels: Which of ``CHANNELS`` a frame has numbers for, in the file's order.
        ends: (3,) of each end site, in the joint's frame [m].
    """

    name: str
    parent: int
    offset: Array
    channels: tuple[str, ...]
    ends: tuple[Array, ...] = ()


def read_hierarchy(lines: Lines, scale: float) -> tuple[BvhJoint, ...]:
    """The joints of a file, parents first; the line ``MOTION`` is taken too.

    Raises:
        DataError: If the hierarchy is wrong; it says in which line.
    """
    if lines.take("HIERARCHY").upper() != "HIERARCHY":
        raise lines.wrong("the first line must be HIERARCHY; this is no BVH file")
    joints: list[BvhJoint] = []
    open_joints: list[int] = []
    while True:
        line = lines.take("MOTION" if joints and not open_joints else "the rest of the joints")
        word, *rest = line.split(None, 1)
        name = "".join(rest)
        match word.upper():
            case "MOTION" if joints and not open_joints:
                return tuple(joints)
            case "}" if open_joints:
                open_joints.pop()
            case "END" if open_joints:
                joint = joints[open_joints[-1]]
                end = _offset(lines, scale)
                _expect(lines, "}")
                joints[open_joints[-1]] = replace(joint, ends=(*joint.ends, end))
            case "ROOT" | "JOINT" if bool(open_joints) == (word.upper() == "JOINT"):
                if joints and not open_joints:
                    raise lines.wrong(f"'{name}' is a second ROOT; a file with one is needed")
                if not name or name in (joint.name for joint in joints):
                    raise lines.wrong(f"{word} needs a name that no other has; it has '{name}'")
                parent = open_joints[-1] if open_joints else -1
                open_joints.append(len(joints))
                joints.append(BvhJoint(name, parent, _offset(lines, scale), _channels(lines)))
            case _:
                wanted = "JOINT, End Site or }" if open_joints else "MOTION" if joints else "ROOT"
                raise lines.wrong(f"'{line[:40]}' where {wanted} should stand")


def _expect(lines: Lines, wanted: str) -> None:
    line = lines.take(wanted)
    if line != wanted:
        raise lines.wrong(f"'{line[:40]}' where {wanted} should stand")


def _offset(lines: Lines, scale: float) -> Array:
    """The brace that opens a joint, and its offset."""
    _expect(lines, "{")
    word, *numbers = lines.take("OFFSET").split()
    if word.upper() != "OFFSET":
        raise lines.wrong(f"'{word}' where OFFSET should stand")
    return read_only(scale * np.array(lines.numbers(" ".join(numbers), 3, "OFFSET")))


def _channels(lines: Lines) -> tuple[str, ...]:
    word, *words = lines.take("CHANNELS").split()
    if word.upper() != "CHANNELS":
        raise lines.wrong(f"'{word}' where CHANNELS should stand")
    if not words or words[0] != str(len(words) - 1):
        raise lines.wrong(
            f"CHANNELS says {words[0] if words else 'nothing'}, and {max(0, len(words) - 1)} follow"
        )
    channels = tuple(name.capitalize() for name in words[1:])
    for name in channels:
        if name not in CHANNELS:
            raise lines.wrong(f"'{name}' is no channel (there are: {', '.join(CHANNELS)})")
        if channels.count(name) > 1:
            raise lines.wrong(f"the channel {name} stands there twice")
    return channels


def in_file_order(joints: Sequence[BvhJoint]) -> list[int]:
    """The joints' indices in the order of a file: each one's children follow it at once."""
    order: list[int] = []
    ahead = [0]
    while ahead:
        index = ahead.pop()
        order.append(index)
        children = [child for child, joint in enumerate(joints) if joint.parent == index]
        ahead += reversed(children)
    return order


def hierarchy_text(joints: Sequence[BvhJoint], scale: float) -> list[str]:
    """The lines of a hierarchy; ``scale`` is metres per unit of the file."""
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
    """Numbers with ten significant digits, so that reading them back loses nothing that counts."""
    return " ".join(f"{number + 0.0:.10g}" for number in numbers)
