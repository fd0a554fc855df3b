"""The hierarchy of a BVH file: parsing and writing its tree of joints."""

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


def read_hierarchy(lines: Lines, scale: float) -> tuple[BvhJoint, ...]:
    """Parses the joints of a file, parents before children, up to the line ``MOTION``.

    Args:
        lines: The lines of the file.
        scale: Metres per unit of the file.

    Raises:
        DataError: If the hierarchy is invalid.
    """
    if lines.take("HIERARCHY").upper() != "HIERARCHY":
        raise lines.wrong("the first line must be HIERARCHY; this is not a BVH file")
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
                    raise lines.wrong(f"'{name}' is a second ROOT; there must be exactly one")
                if not name or name in (joint.name for joint in joints):
                    raise lines.wrong(f"{word} needs a unique name; it has '{name}'")
                parent = open_joints[-1] if open_joints else -1
                open_joints.append(len(joints))
                joints.append(BvhJoint(name, parent, _offset(lines, scale), _channels(lines)))
            case _:
                wanted = "JOINT, End Site or }" if open_joints else "MOTION" if joints else "ROOT"
                raise lines.wrong(f"'{line[:40]}' where {wanted} is expected")


def _expect(lines: Lines, wanted: str) -> None:
    line = lines.take(wanted)
    if line != wanted:
        raise lines.wrong(f"'{line[:40]}' where {wanted} is expected")


def _offset(lines: Lines, scale: float) -> Array:
    """Parses the opening brace of a joint, and returns its offset."""
    _expect(lines, "{")
    word, *numbers = lines.take("OFFSET").split()
    if word.upper() != "OFFSET":
        raise lines.wrong(f"'{word}' where OFFSET is expected")
    return read_only(scale * np.array(lines.numbers(" ".join(numbers), 3, "OFFSET")))


def _channels(lines: Lines) -> tuple[str, ...]:
    word, *words = lines.take("CHANNELS").split()
    if word.upper() != "CHANNELS":
        raise lines.wrong(f"'{word}' where CHANNELS is expected")
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
    ahead = [0]
    while ahead:
        index = ahead.pop()
        order.append(index)
        children = [child for child, joint in enumerate(joints) if joint.parent == index]
        ahead += reversed(children)
    return order


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
