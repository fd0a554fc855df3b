"""Bodies: a skeleton with its surface, its markers and the parameters of shape models."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np

from regkit.body.listed import ListedShape
from regkit.geometry.capsules import Capsules
from regkit.geometry.surface import SkinnedSurface
from regkit.skeleton import Placement, Pose, Skeleton
from regkit.system.arrays import Array, Indices


@dataclass(frozen=True)
class Markers:
    """Named points on segments, such as joints and fingertips.

    Attributes:
        names: (M,).
        segments: The segment that carries each, (M,).
        points: Positions in the segments' frames, (M, 3) [m].
    """

    names: tuple[str, ...]
    segments: Indices
    points: Array

    def place(self, transforms: Array) -> Array:
        """Positions in the world, (M, 3) [m], for T_world_segment (S, 4, 4)."""
        carriers = transforms[self.segments]
        return np.asarray(
            (carriers[:, :3, :3] @ self.points[:, :, None])[:, :, 0] + carriers[:, :3, 3]
        )


@dataclass(frozen=True)
class Stance:
    """How a body is likely to be found in the first frame.

    Attributes:
        name: What a person would call it.
        pose: A pose of the body; of its root only the rotation counts, before it faces the camera.
    """

    name: str
    pose: Pose


@dataclass(frozen=True)
class Body:
    """What is registered, at its size.

    In the rest pose the frames of the segments are parallel; x points to the body's left, y up (for
    a
    hand: along the fingers) and z to the front (for a hand: out of the palm).

    Attributes:
        name: Name of the template.
        skeleton: The tree of segments.
        capsules: The surface; also what shape models are made of that the template does not list.
        markers: Points that can be compared with measured ones.
        shapes: The primitives that the template lists, by the kind of shape model.
        stances: Likely poses for the first frame.
        upright: Whether y points up in the first frame, with the front towards the camera.
        surface: Its skinned mesh or cloud, if the template brings one.
        size: Height of a person, length of a hand, or another length that a person would name [m].
    """

    name: str
    skeleton: Skeleton
    capsules: Capsules
    markers: Markers
    shapes: Mapping[str, ListedShape[Any]]
    stances: tuple[Stance, ...]
    size: float
    upright: bool
    surface: SkinnedSurface | None = None

    def place(self, pose: Pose) -> Placement:
        """Returns the skeleton's placement in a pose."""
        return Placement.of(self.skeleton, pose)
