"""The shapes of a model in the frames of its segments, as pages and pictures show them."""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Mapping
from dataclasses import dataclass, fields
from typing import Any, ClassVar

import numpy as np
from numpy.typing import NDArray

from regkit.geometry.rotation import to_matrix
from regkit.system.arrays import Array, Indices, real_numbers, whole_numbers
from regkit.viewer.packed import packed

INTEGERS = {"segments": "u2", "carriers": "u2", "triangles": "u4"}
"""Types of the arrays that hold indices; others hold real numbers."""


@dataclass(frozen=True)
class Shape(ABC):
    """A group of primitives, or a mesh."""

    kind: ClassVar[str]
    widths: ClassVar[Mapping[str, tuple[int | str, ...]]]
    """Shape of each array; a letter stands for a number that is the same wherever it occurs."""

    def json(self) -> dict[str, Any]:
        """Returns the shape as JSON."""
        return {"kind": self.kind} | {
            one.name: packed(getattr(self, one.name), INTEGERS.get(one.name, "f4"))
            for one in fields(self)
        }

    def arrays(self) -> dict[str, NDArray[Any]]:
        """Returns the shape as named arrays."""
        return {"kind": np.array(self.kind)} | {
            one.name: getattr(self, one.name).astype(INTEGERS.get(one.name, "f4"))
            for one in fields(self)
        }

    @abstractmethod
    def placed(self, transforms: Array) -> Array:
        """Returns the positions of the shape's points in the world [m].

        Args:
            transforms: Quaternion (x, y, z, w) and origin [m] of each segment, (S, 7).
        """


@dataclass(frozen=True)
class Ellipsoids(Shape):
    """K ellipsoids.

    Attributes:
        segments: Segment of each, (K,).
        centres: Centres, (K, 3) [m].
        rotations: Quaternions (x, y, z, w) of the axes, (K, 4).
        radii: Radii along the axes, (K, 3) [m].
    """

    kind = "ellipsoids"
    widths: ClassVar = {
        "segments": ("K",), "centres": ("K", 3), "rotations": ("K", 4), "radii": ("K", 3)
    }  # fmt: skip
    segments: Indices
    centres: Array
    rotations: Array
    radii: Array

    def placed(self, transforms: Array) -> Array:
        """Returns the centres, (K, 3) [m]."""
        return moved(transforms[self.segments], self.centres)


@dataclass(frozen=True)
class CapsuleShapes(Shape):
    """K tapered capsules.

    Attributes:
        segments: Segment of each, (K,).
        ends: Centres of the two end spheres, (K, 2, 3) [m].
        radii: Their radii, (K, 2) [m].
    """

    kind = "capsules"
    widths: ClassVar = {"segments": ("K",), "ends": ("K", 2, 3), "radii": ("K", 2)}
    segments: Indices
    ends: Array
    radii: Array

    def placed(self, transforms: Array) -> Array:
        """Returns the ends, (K, 2, 3) [m]."""
        return moved(transforms[self.segments][:, None], self.ends)


@dataclass(frozen=True)
class MeshShape(Shape):
    """A mesh by linear blend skinning: v = sum_c w_c T_c inv(rest_c) v.

    Attributes:
        vertices: Vertices in the rest pose, (V, 3) [m].
        triangles: Their indices, (T, 3).
        carriers: Segments of each vertex, (V, C).
        weights: Weights of the carriers, (V, C).
        rest: Quaternion and origin of each segment in the rest pose, (S, 7).
    """

    kind = "mesh"
    widths: ClassVar = {
        "vertices": ("V", 3), "triangles": ("T", 3), "carriers": ("V", "C"), "weights": ("V", "C"),
        "rest": ("S", 7),
    }  # fmt: skip
    vertices: Array
    triangles: Indices
    carriers: Indices
    weights: Array
    rest: Array

    def placed(self, transforms: Array) -> Array:
        """Returns the vertices, (V, 3) [m]."""
        carried = moved(transforms[self.carriers], self._local())
        return np.asarray((self.weights[..., None] * carried).sum(axis=1))

    def dots(self, most: int) -> Dots:
        """Returns at most ``most`` vertices as points, each on its main carrier."""
        main = np.arange(len(self.vertices)), self.weights.argmax(axis=1)
        every = max(1, -(-len(self.vertices) // most))
        return Dots(self.carriers[main][::every], self._local()[main][::every])

    def _local(self) -> Array:
        """Returns the vertices in the frames of their carriers, (V, C, 3) [m]."""
        rest = self.rest[self.carriers]
        inverse = np.swapaxes(to_matrix(rest[..., :4]), -1, -2)
        offsets = self.vertices[:, None] - rest[..., 4:]
        return np.asarray((inverse @ offsets[..., None])[..., 0])


@dataclass(frozen=True)
class Dots(Shape):
    """K points.

    Attributes:
        segments: Segment of each, (K,).
        centres: Positions, (K, 3) [m].
    """

    kind = "points"
    widths: ClassVar = {"segments": ("K",), "centres": ("K", 3)}
    segments: Indices
    centres: Array

    def placed(self, transforms: Array) -> Array:
        """Returns the points, (K, 3) [m]."""
        return moved(transforms[self.segments], self.centres)


KINDS: dict[str, type[Shape]] = {
    one.kind: one for one in (Ellipsoids, CapsuleShapes, MeshShape, Dots)
}
"""The shapes by kind."""


def moved(transforms: Array, points: Array) -> Array:
    """Returns points (..., 3) [m] moved by quaternions and origins (..., 7)."""
    rotated = (to_matrix(transforms[..., :4]) @ points[..., None])[..., 0]
    return np.asarray(rotated + transforms[..., 4:])


def shape_of(named: Mapping[str, NDArray[Any]], segments: int) -> Shape:
    """Returns the shape of named arrays from ``Shape.arrays``.

    Raises:
        KeyError: If an array is missing, or the kind is unknown.
        DataError: If an array holds no numbers.
        ValueError: If an array has a wrong shape, or an index is out of range.
    """
    kind = KINDS[str(named["kind"])]
    values: dict[str, NDArray[Any]] = {
        name: (whole_numbers if name in INTEGERS else real_numbers)(named[name], name)
        for name in kind.widths
    }
    lengths: dict[int | str, int] = {"S": segments}
    for name, array in values.items():
        wanted = kind.widths[name]
        known = len(array.shape) == len(wanted) and all(
            lengths.setdefault(width, size) == size if isinstance(width, str) else width == size
            for width, size in zip(wanted, array.shape, strict=True)
        )
        if not known or not np.isfinite(array).all():
            raise ValueError(f"'{name}' of {kind.kind} has the shape {array.shape}")
    bounds = {"segments": segments, "carriers": segments, "triangles": lengths.get("V", 0)}
    for name in values.keys() & bounds.keys():
        indices = values[name]
        if indices.size and not (indices.min() >= 0 and indices.max() < bounds[name]):
            raise ValueError(f"'{name}' of {kind.kind} is out of range")
    return kind(**values)
