"""Resolutions of a body's surface and of a cloud, from few points to all of them."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from regkit.body import Body
from regkit.clouds import spacing, voxel_downsampled
from regkit.clouds.neighbourhoods import tree_normals
from regkit.clouds.tree import Tree
from regkit.gaussians.cloud_shape import CloudShape
from regkit.geometry.surface import SkinnedSurface
from regkit.observation import Observation
from regkit.primitives import Gaussians
from regkit.system.arrays import Array, Indices
from regkit.system.errors import ConfigError

LEAST_STEP = 1.2
"""Voxels of successive resolutions differ at least by about this factor; closer ones leave nearly
the same points."""


@dataclass(frozen=True)
class Resolution:
    """One resolution of a body.

    Attributes:
        voxel: Size of the voxels with one point each [m].
        width: Standard deviation of a Gaussian along the surface [m].
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
        body: The body.
        shape: Shape model of its surface.
        coarsest: Size of the largest voxels, as a fraction of the body's size.
        finest: Size of the smallest voxels, as a fraction of the spacing of neighbouring points.
        count: Number of resolutions, or fewer if the voxels differ too little.
        width: Standard deviation of a pair of Gaussians, in voxels; each has half the variance.

    Raises:
        ConfigError: If the body has no surface.
    """
    surface = body.surface
    if surface is None:
        raise ConfigError(
            f"the template '{body.name}' has no surface, which this method needs; use a template "
            "of kind cloud, or the method direct"
        )
    smallest = finest * spacing(surface.points[:, 0])
    # Voxels smaller than the spacing of the points keep all points, but narrow the Gaussians.
    largest = max(coarsest * body.size, smallest)
    distinct = 1 + round(float(np.log(largest / smallest) / np.log(LEAST_STEP)))
    voxels = np.geomspace(largest, smallest, min(count, distinct))
    found = []
    for index, voxel in reversed(list(enumerate(voxels))):
        if index < len(voxels) - 1:
            surface = voxel_downsampled_surface(surface, float(voxel))
        deviation = float(width * voxel / np.sqrt(2.0))
        downsampled = replace(body, surface=surface)
        found.append(Resolution(float(voxel), deviation, shape.wide(deviation).bind(downsampled)))
    return tuple(reversed(found))


def observations(
    observation: Observation, levels: tuple[Resolution, ...]
) -> tuple[Observation, ...]:
    """Returns a cloud at the resolutions of a body; at the finest it has every point.

    The points are sorted so that neighbours are close in memory.
    """
    points, found = observation.points, []
    for index, level in reversed(list(enumerate(levels))):
        if index < len(levels) - 1:
            points = voxel_downsampled(points, level.voxel)
        found.append(sorted_observation(Tree.of(points), level))
    return tuple(reversed(found))


def sorted_observation(tree: Tree, level: Resolution) -> Observation:
    """Returns the points of a tree, in its order, as the data of a resolution."""
    ones = np.ones(len(tree))
    return Observation(tree.points, ones, level.width**2 * ones, normals=tree_normals(tree))


def voxel_downsampled_surface(surface: SkinnedSurface, voxel: float) -> SkinnedSurface:
    """Returns a surface with one point per voxel [m] of each segment's frame, without blending."""
    owners, points, _ = surface.unblended()
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
