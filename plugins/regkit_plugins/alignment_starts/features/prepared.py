"""A cloud, prepared to be matched: few points, their normals, descriptors and surroundings."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from regkit.clouds import voxel_downsampled
from regkit.clouds.compiled_normals import least_directions
from regkit.clouds.tree import Tree
from regkit.system.arrays import Array, Singles
from regkit_plugins.alignment_starts.features.compiled_buckets import pairs_within
from regkit_plugins.alignment_starts.features.compiled_descriptors import descriptors
from regkit_plugins.alignment_starts.features.compiled_surroundings import (
    Surroundings,
    surroundings,
)
from regkit_plugins.alignment_starts.features.orientation import oriented

NEIGHBOURS = 16
"""Number of points for the normal of a point, including itself."""

PIXEL = 1.5
"""Side of a view's pixels, in voxels."""

JUDGING = 350
"""Number of points by which most motions are judged."""


@dataclass(frozen=True)
class Surface:
    """A cloud with normals.

    Attributes:
        origin: The points' mean, (3,) [m], the origin of all other coordinates.
        tree: The points.
        normals: Their normals of any sign in the tree's order, (N, 3).
    """

    origin: Array
    tree: Tree
    normals: Array

    @classmethod
    def of(cls, points: Array) -> Surface:
        """Returns the surface of points (N, 3) [m]."""
        origin = points.mean(axis=0)
        tree = Tree.of(points - origin)
        _, near = tree.nearest(tree.points, min(NEIGHBOURS, len(tree)))
        return cls(origin, tree, least_directions(tree.points, near))


@dataclass(frozen=True)
class Prepared:
    """A surface at one resolution.

    Attributes:
        around: Points, normals, and what is around them.
        descriptors: Descriptors of the points, (N, B).
        judging: Points and normals by which motions are judged, (J, 3) each.
    """

    around: Surroundings
    descriptors: Singles
    judging: tuple[Array, Array]

    @classmethod
    def of(cls, surface: Surface, voxel: float, radius: float) -> Prepared:
        """Returns a surface with about one point in each voxel.

        Args:
            surface: The surface.
            voxel: Side of the voxels [m].
            radius: Radius of the descriptors [m].
        """
        means = voxel_downsampled(surface.tree.points, voxel)
        _, places = surface.tree.nearest(means, 1)
        points, normals = surface.tree.points[places[:, 0]], surface.normals[places[:, 0]]
        normals, view = oriented(points, normals, voxel)
        found = descriptors(points, normals, pairs_within(points, radius), radius)
        direction = np.array([0.0, 0.0, 1.0]) if view is None else view
        some = np.random.default_rng(0).permutation(len(points))[:JUDGING]
        return cls(
            surroundings(points, normals, voxel, direction, view is not None, PIXEL * voxel),
            found,
            (points[some], normals[some]),
        )
