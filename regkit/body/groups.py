"""Groups of segments that share their proportions, such as left and right arm."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from regkit.body import BodyDescription
from regkit.skeleton import SegmentDescription
from regkit.skeleton.description import parents_first
from regkit.system.arrays import Array, Indices

_SIDES = ("left", "right")


@dataclass(frozen=True)
class Groups:
    """The groups of a template's segments, and the direction of every segment's bone.

    Attributes:
        names: Names of the groups, (G,).
        of_segments: Group of each segment, in the skeleton's order, (S,).
        bones: Unit vectors of the bones in the segments' frames, (S, 3); zero without a direction.
    """

    names: tuple[str, ...]
    of_segments: Indices
    bones: Array

    @classmethod
    def of(cls, description: BodyDescription) -> Groups:
        """Returns the groups of a template: ``left_thigh`` and ``right_thigh`` form ``thigh``."""
        order = parents_first(description.segments)
        groups = [group_name(segment) for segment in order]
        names = tuple(dict.fromkeys(groups))
        bones = [_bone(name, description.segments) for name in order]
        return cls(names, np.array([names.index(group) for group in groups]), np.array(bones))


def group_name(segment: str) -> str:
    """Returns the segment's name without its side."""
    parts = [part for part in segment.split("_") if part.lower() not in _SIDES]
    return "_".join(parts) or segment


def _bone(name: str, segments: dict[str, SegmentDescription]) -> Array:
    """Returns the direction from the joint to child joints, else markers, else the surface."""
    segment = segments[name]
    children = [child.offset for child in segments.values() if child.parent == name]
    surface = [capsule.end for capsule in segment.capsules]
    for ends in (children, list(segment.markers.values()), surface):
        # Children to the left and right of a trunk leave the direction in the middle.
        direction = np.sum(ends, axis=0) if ends else np.zeros(3)
        length = float(np.linalg.norm(direction))
        if length > 1e-6:
            return np.asarray(direction / length)
    return np.zeros(3)
