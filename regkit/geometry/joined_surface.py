"""Surfaces of several bodies in one."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from regkit.geometry.rigid import inverse, transformed
from regkit.geometry.surface import SkinnedSurface
from regkit.system.arrays import Array, Indices


def joined(surfaces: Sequence[SkinnedSurface], count: int) -> SkinnedSurface:
    """Returns the surfaces of several bodies as one.

    Args:
        surfaces: The surfaces, whose segments are those of the whole.
        count: Number of segments of the whole.
    """
    most = max(one.segments.shape[1] for one in surfaces)
    wide = [_widened(one, most) for one in surfaces]
    normals = [one.normals for one in wide]
    starts = np.cumsum([0, *map(len, wide)])
    rest = np.tile(np.eye(4), (count, 1, 1))
    for one in wide:
        if one.rest is not None:
            own = np.unique(one.segments)
            rest[own] = one.rest[own]
    return SkinnedSurface(
        segments=np.concatenate([one.segments for one in wide]),
        points=np.concatenate([one.points for one in wide]),
        blend=np.concatenate([one.blend for one in wide]),
        normals=None
        if any(one is None for one in normals)
        else np.concatenate([one for one in normals if one is not None]),
        faces=np.concatenate([one.faces + at for one, at in zip(wide, starts, strict=False)]),
        rest=None if any(one.rest is None for one in wide) else rest,
    )


def on_segments_of(surface: SkinnedSurface, order: Indices, count: int) -> SkinnedSurface:
    """Returns a surface whose segments have other indices.

    Args:
        surface: The surface.
        order: New index of each of its segments, (S,).
        count: Number of segments of the whole.
    """
    rest = None
    if surface.rest is not None:
        rest = np.tile(np.eye(4), (count, 1, 1))
        rest[order] = surface.rest
    return replace(surface, segments=order[surface.segments], rest=rest)


def without(surface: SkinnedSurface, segment: int) -> SkinnedSurface:
    """Returns a surface without the vertices that follow a segment most."""
    strongest = surface.segments[np.arange(len(surface)), surface.blend.argmax(axis=1)]
    kept = strongest != segment
    new = np.cumsum(kept) - 1
    return replace(
        surface,
        segments=surface.segments[kept],
        points=surface.points[kept],
        blend=surface.blend[kept],
        normals=None if surface.normals is None else surface.normals[kept],
        faces=new[surface.faces[kept[surface.faces].all(axis=1)]],
    )


def in_frame(surface: SkinnedSurface, segment: int, T_old_new: Array) -> SkinnedSurface:
    """Returns a surface for which the frame of a segment is another one, (4, 4) [m]."""
    own = surface.segments == segment
    points = surface.points.copy()
    points[own] = transformed(inverse(T_old_new), points[own])
    normals = surface.normals
    if normals is not None:
        normals = normals.copy()
        normals[own] = normals[own] @ T_old_new[:3, :3]
    rest = surface.rest
    if rest is not None:
        rest = rest.copy()
        rest[segment] = rest[segment] @ T_old_new
    return replace(surface, points=points, normals=normals, rest=rest)


def moved_rest(surface: SkinnedSurface, T_new_old: Array) -> SkinnedSurface:
    """Returns a surface that was made in another place, moved by a transform (4, 4) [m]."""
    return surface if surface.rest is None else replace(surface, rest=T_new_old @ surface.rest)


def _widened(surface: SkinnedSurface, most: int) -> SkinnedSurface:
    """Returns a surface whose vertices have as many segments each, some with a weight of zero."""
    more = most - surface.segments.shape[1]
    if not more:
        return surface

    carriers = np.concatenate([surface.segments, np.repeat(surface.segments[:, :1], more, 1)], 1)
    blend = np.concatenate([surface.blend, np.zeros((len(surface), more))], axis=1)
    return replace(
        surface,
        segments=carriers,
        points=_padded(surface.points, more),
        blend=blend,
        normals=None if surface.normals is None else _padded(surface.normals, more),
    )


def _padded(vectors: Array, more: int) -> Array:
    """Returns vectors (V, A, 3) with the first of each row repeated."""
    return np.concatenate([vectors, np.repeat(vectors[:, :1], more, axis=1)], axis=1)
