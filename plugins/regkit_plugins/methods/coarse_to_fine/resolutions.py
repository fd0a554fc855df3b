"""A body's surface and a cloud at several resolutions, from few points to all of them."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from regkit.body import Body
from regkit.clouds import normals, spacing, voxel_downsampled
from regkit.gaussians.cloud_shape import CloudShape
from regkit.geometry.surface import SkinnedSurface
from regkit.observation import Observation
from regkit.primitives import Gaussians
from regkit.system.arrays import Array, Indices
from regkit.system.errors import ConfigError


@dataclass(frozen=True)
class Resolution:
    """One resolution of a body.

    Attributes:
        voxel: Side of the cubes that hold one point each [m].
        width: Standard deviation of a Gaussian in the surface [m].
        primitives: The body's Gaussians.
    """

    voxel: float
    width: float
    primitives: Gaussians


def resolutions(
    body: Body, shape: CloudShape, *, coarsest: float, finest: float, count: int, width: float
) -> tuple[Resolution, ...]:
    """Returns the resolutions of a body, the coarsest first; the finest has every point.

    Args:
        body: Whose surface it is.
        shape: What makes Gaussians of it.
        coarsest: Side of the largest voxels, as a part of the body's size.
        finest: Side of the smallest, as a part of the distance of neighbouring points.
        count: How many resolutions.
        width: Standard deviation of a pair of Gaussians, in voxels; each has half the variance.

    Raises:
        ConfigError: If the body has no surface.
    """
    surface = body.surface
    if surface is None:
        raise ConfigError(
            f"the template '{body.name}' has no surface to make Gaussians of; take a template of "
            "kind cloud, or the method direct"
        )
    least = finest * spacing(surface.points[:, 0])
    # A voxel smaller than the distance of the points thins nothing, but Gaussians get narrower.
    voxels = np.geomspace(max(coarsest * body.size, least), least, count)
    found = []
    for index, voxel in reversed(list(enumerate(voxels))):
        if index < count - 1:
            surface = voxel_downsampled_surface(surface, float(voxel))
        deviation = float(width * voxel / np.sqrt(2.0))
        thin = replace(body, surface=surface)
        found.append(Resolution(float(voxel), deviation, shape.wide(deviation).bind(thin)))
    return tuple(reversed(found))


def observations(
    observation: Observation, levels: tuple[Resolution, ...]
) -> tuple[Observation, ...]:
    """Returns a cloud at the resolutions of a body; at the finest it has every point."""
    points, found = observation.points, []
    for index, level in reversed(list(enumerate(levels))):
        if index < len(levels) - 1:
            points = voxel_downsampled(points, level.voxel)
        ones = np.ones(len(points))
        found.append(Observation(points, ones, level.width**2 * ones, normals=normals(points)))
    return tuple(reversed(found))


def voxel_downsampled_surface(surface: SkinnedSurface, voxel: float) -> SkinnedSurface:
    """One point in each voxel [m] of each segment's own frame, carried by that segment alone."""
    carrier = surface.blend.argmax(axis=1)
    vertices = np.arange(len(surface))
    owners, points = surface.segments[vertices, carrier], surface.points[vertices, carrier]
    pieces: list[Array] = []
    segments: list[Indices] = []
    for segment in np.unique(owners):
        pieces.append(voxel_downsampled(points[owners == segment], voxel))
        segments.append(np.full(len(pieces[-1]), segment, dtype=np.intp))
    return SkinnedSurface(
        segments=np.concatenate(segments)[:, None],
        points=np.concatenate(pieces)[:, None],
        blend=np.ones((sum(map(len, pieces)), 1)),
        normals=None,
        faces=np.empty((0, 3), dtype=np.intp),
    )
