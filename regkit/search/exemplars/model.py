"""A body as compiled loops see it: named tuples of arrays."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from regkit.body import Body
from regkit.system.arrays import Array, Indices


class Hull(NamedTuple):
    """The surface as capsules.

    Attributes:
        segments: Segment of each capsule, (C,).
        ends: Their ends in the segments' frames, (C, 2, 3) [m].
        radii: Their radii, (C, 2) [m].
    """

    segments: Indices
    ends: Array
    radii: Array

    @classmethod
    def of(cls, body: Body) -> Hull:
        """Returns the surface of a body."""
        return cls(body.capsules.segments, body.capsules.ends, body.capsules.radii)


class Spheres(NamedTuple):
    """The body as spheres on the axes of its capsules.

    Attributes:
        segments: Segment of each sphere, (P,).
        points: Centres in the segments' frames, (P, 3) [m].
        radii: Their radii, (P,) [m].
        optional: Whether the data may lack each sphere, (P,).
    """

    segments: Indices
    points: Array
    radii: Array
    optional: NDArray[np.bool_]

    @classmethod
    def of(cls, body: Body, spacing: float) -> Spheres:
        """Returns spheres at most ``spacing`` [m] apart on the axes of a body's capsules."""
        axes = body.capsules.axis_points(spacing)
        return cls(axes.segments, axes.points, axes.radii, body.is_optional(axes.segments))


class Grid(NamedTuple):
    """A depth image in blocks, as a pinhole camera sees them.

    Attributes:
        depth: Depth of each block, (H, W) [m]; inf where nothing is, -1 where it is unknown.
        nearest: Row and column of the nearest block with depth, (2, H, W).
        intrinsics: fx, fy, cx, cy in blocks, (4,).
    """

    depth: Array
    nearest: Array
    intrinsics: Array
