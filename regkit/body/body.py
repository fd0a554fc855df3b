"""Bodies: skeletons with surface, markers and shape parameters."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from functools import cached_property
from typing import Any

import numpy as np
from numpy.typing import NDArray

from regkit.body.free_body import FreeBody
from regkit.body.listed import ListedShape
from regkit.body.parts import Part
from regkit.geometry.capsules import AxisPoints, Capsules
from regkit.geometry.surface import SkinnedSurface
from regkit.skeleton import Placement, Pose, Skeleton
from regkit.system.arrays import Array, Indices
from regkit.system.brief import Brief

SPACING = 0.05
"""Distance of the points on a body's axes, as a fraction of its size."""


@dataclass(frozen=True)
class Markers(Brief):
    """Named points on segments, such as joints and fingertips.

    Attributes:
        names: Names of the markers, (M,).
        segments: Segment of each marker, (M,).
        points: Positions in the segments' frames, (M, 3) [m].
    """

    names: tuple[str, ...]
    segments: Indices
    points: Array

    def place(self, transforms: Array) -> Array:
        """Returns positions in the world, (..., M, 3) [m], for T_world_segment (..., S, 4, 4)."""
        carriers = transforms[..., self.segments, :, :]
        rotated = (carriers[..., :3, :3] @ self.points[:, :, None])[..., 0]
        return np.asarray(rotated + carriers[..., :3, 3])

    def jacobian(self, placement: Placement) -> Array:
        """Returns the derivative of the positions to the degrees of freedom, (M, 3, n)."""
        arms = placement.transforms[self.segments, :3, :3] @ self.points[:, :, None]
        twists = placement.jacobian[self.segments]
        return np.asarray(twists[:, :3] + np.cross(twists[:, 3:], arms, axis=1))


@dataclass(frozen=True)
class Stance:
    """A likely pose in the first frame.

    Attributes:
        name: A descriptive name.
        pose: Joint angles and the root's rotation before the body faces the camera; the root's
            position is ignored.
    """

    name: str
    pose: Pose


@dataclass(frozen=True)
class Body(Brief):
    """The body to register, at its size.

    In the rest pose the frames of the segments are parallel. For a person, x points to the left, y
    up and z to the front; for a hand, y points along the fingers and z out of the palm.

    Attributes:
        name: Name of the template.
        skeleton: The tree of segments.
        capsules: The surface as capsules, from which shape models without listed parameters make
            their primitives.
        markers: Points that can be compared with measured ones.
        shapes: Primitives listed in the template, by kind of shape model, or ``KIND/NAME``.
        stances: Likely poses in the first frame.
        size: Characteristic length, such as a person's height or a hand's length [m].
        upright: Whether y points up in the first frame, with the front towards the camera.
        surface: Skinned mesh or cloud of the template, if it has one.
        optional: Indices of the segments that the data may lack.
        parts: The parts of a composed body, such as its hands; none if it is not composed.
        base: The same body with its own segments in place of attached parts, which is found first;
            None if it has no attached parts.
        free_bodies: The bodies of which it consists, if several move freely beside each other.
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
    optional: tuple[int, ...] = ()
    parts: tuple[Part, ...] = ()
    base: Body | None = None
    free_bodies: tuple[FreeBody, ...] = ()

    def __repr__(self) -> str:
        """Returns what the body consists of, in one line."""
        parts = [f"{len(self.capsules)} capsules", f"{len(self.markers.names)} markers"]
        if self.surface is not None:
            parts.append(f"{len(self.surface.points)} surface points")
        return f"<Body {self.name}: size {self.size:.4g} m, {self.skeleton!r}, {', '.join(parts)}>"

    @cached_property
    def required(self) -> Capsules:
        """The surface that the data must show unless something hides it."""
        return self.capsules.selected(~self.is_optional(self.capsules.segments))

    @cached_property
    def axes(self) -> AxisPoints:
        """Points on the axes of the surface, in the segments' frames."""
        return self.capsules.axis_points(SPACING * self.size)

    @cached_property
    def required_axes(self) -> AxisPoints:
        """Points on the axes of the required surface, in the segments' frames."""
        return self.required.axis_points(SPACING * self.size)

    @cached_property
    def limb_radius(self) -> float:
        """Radius of a typical limb of the required surface [m]."""
        return self.required.limb_radius()

    @property
    def attached_parts(self) -> tuple[Part, ...]:
        """The parts that are attached to another part."""
        return tuple(part for part in self.parts if not part.free)

    def part_size(self, segment: int) -> float:
        """Returns the size [m] of the part with a segment, or of the body."""
        return next((part.size for part in self.parts if segment in part.segments), self.size)

    def is_optional(self, segments: Indices) -> NDArray[np.bool_]:
        """Returns whether the data may lack each of some segments (K,), (K,)."""
        return np.isin(segments, self.optional)

    def place(self, pose: Pose) -> Placement:
        """Returns the skeleton's placement in a pose."""
        return Placement.of(self.skeleton, pose)
