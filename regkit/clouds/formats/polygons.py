"""Polygons cut into triangles."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field

import numpy as np

from regkit.system.arrays import Array, Indices
from regkit.system.errors import DataError
from regkit.system.notes import note


@dataclass
class Polygons:
    """Polygons of any number of corners.

    Attributes:
        path: The file, for messages.
        groups: Corners (F, n) of the polygons of n corners.
        thin: Number of polygons of fewer than three corners.
    """

    path: str
    groups: list[Indices] = field(default_factory=list)
    thin: int = 0

    @classmethod
    def of(cls, path: str, faces: Sequence[Sequence[int]]) -> Polygons:
        """Returns the polygons of a list of corners."""
        by_count: dict[int, list[Sequence[int]]] = {}
        for face in faces:
            by_count.setdefault(len(face), []).append(face)
        found = cls(path)
        for count, group in sorted(by_count.items()):
            found.add(np.array(group, dtype=np.intp).reshape(-1, count))
        return found

    def add(self, corners: Indices) -> None:
        """Adds polygons (F, n) with the same number of corners; thin ones cover no surface."""
        if corners.shape[1] >= 3:
            self.groups.append(corners)
        else:
            self.thin += len(corners)

    def triangles(self, vertices: Array) -> Indices:
        """Returns the corners of triangles (T, 3).

        Args:
            vertices: The vertices, (V, 3).

        Raises:
            DataError: If a corner is no vertex.
        """
        if self.thin:
            note(f"{self.thin} faces of fewer than three corners are passed over", place=self.path)
        found = [np.empty((0, 3), dtype=np.intp)]
        # How a polygon is cut depends on no length, and damaged ones may overflow.
        vertices = vertices / max(float(np.abs(vertices).max(initial=0.0)), 1e-300)
        for corners in self.groups:
            bad = np.argwhere((corners < 0) | (corners >= len(vertices)))
            if len(bad):
                raise DataError(
                    f"a face has the vertex {corners[tuple(bad[0])]}; there are {len(vertices)}, "
                    "from 0",
                    place=self.path,
                )
            found += _cut(vertices, corners)
        return np.concatenate(found)


def _cut(vertices: Array, corners: Indices) -> list[Indices]:
    """Returns triangles (T, 3) of polygons (F, n): fans of the convex ones, ears of the others."""
    count = corners.shape[1]
    if count == 3:
        return [corners]
    first = np.zeros(count - 2, dtype=np.intp)
    order = np.column_stack([first, np.arange(1, count - 1), np.arange(2, count)])
    fans = corners[:, order]
    sides = vertices[fans[:, :, 1:]] - vertices[fans[:, :, :1]]
    normals = np.cross(sides[:, :, 0], sides[:, :, 1])
    turns = np.einsum("fni,fi->fn", normals, normals.sum(axis=1))
    convex = (turns >= 0.0).all(axis=1)
    ears = [_ears(vertices, polygon) for polygon in corners[~convex]]
    return [fans[convex].reshape(-1, 3), *ears]


def _ears(vertices: Array, polygon: Indices) -> Indices:
    """Returns triangles (n - 2, 3) of a polygon (n,) by cutting its ears off one by one.

    Source: G. Meisters, Polygons have ears, American Mathematical Monthly 82, 1975.
    """
    points = vertices[polygon] - vertices[polygon].mean(axis=0)
    normal = np.cross(points, np.roll(points, -1, axis=0)).sum(axis=0)
    _, _, axes = np.linalg.svd(normal[None])
    flat = points @ axes[1:].T
    if np.linalg.det(np.vstack([axes[1:], normal])) < 0.0:
        flat = flat[:, ::-1]
    left, found = list(range(len(polygon))), []
    while len(left) > 3:
        at = next((at for at in range(len(left)) if _is_ear(flat, left, at)), 0)
        found.append([left[at - 1], left[at], left[(at + 1) % len(left)]])
        del left[at]
    order = np.array([*found, left], dtype=np.intp)
    return np.asarray(polygon[order])


def _is_ear(flat: Array, left: list[int], at: int) -> bool:
    a, b, c = left[at - 1], left[at], left[(at + 1) % len(left)]
    others = flat[[n for n in left if n not in (a, b, c)]]
    if _turn(flat[a], flat[b], flat[c][None])[0] <= 0.0:
        return False
    inside = (
        (_turn(flat[a], flat[b], others) >= 0.0)
        & (_turn(flat[b], flat[c], others) >= 0.0)
        & (_turn(flat[c], flat[a], others) >= 0.0)
    )
    return not inside.any()


def _turn(a: Array, b: Array, c: Array) -> Array:
    """Returns twice the area of the triangles a (2,), b (2,), c (N, 2), positive to the left."""
    return np.asarray(
        (b[0] - a[0]) * (c[:, 1] - a[1]) - (b[1] - a[1]) * (c[:, 0] - a[0]), dtype=np.float64
    )
