"""One cluster of points for each segment of a body, and for both sides where it has two."""

from __future__ import annotations

import numpy as np

from regkit.body import Body
from regkit.body.freedoms import MIRROR
from regkit.geometry.capsule_points import points_inside, spacing_of
from regkit.geometry.capsules import Capsules
from regkit.geometry.rigid import inverse, transformed
from regkit.skeleton import Mirroring
from regkit.system.arrays import Array, Indices
from regkit.system.errors import ConfigError
from regkit.tuning.layout.clusters import Cluster

POINTS = 8000
"""About the number of points that fill the capsules of a segment."""

APART = 0.02
"""Farthest that the mirror images of a segment's origin and mean are from those of its counterpart,
as a fraction of the body's size."""


LOPSIDED = 0.1
"""Most by which the share of points on one side differs from a half in a segment in the middle."""


def segment_clusters(body: Body, most: int, *, alike: bool) -> list[Cluster]:
    """Returns the clusters of the segments with capsules, for at most ``most`` primitives.

    Segments that are fixed to others join them if there are too few primitives.

    Args:
        body: The body.
        most: Number of primitives.
        alike: Whether all segments have the same mass, instead of that of their volume.

    Raises:
        ConfigError: If the body has no capsules, or the segments that move are too many.
    """
    if not len(body.capsules):
        raise ConfigError(
            f"the template '{body.name}' has no capsules, which primitives could fill; give its "
            "segments capsules"
        )
    carriers = np.arange(len(body.skeleton.names))
    if most < len(np.unique(body.capsules.segments)):
        carriers = _carriers(body)
    least = len(np.unique(carriers[body.capsules.segments]))
    if most < least:
        raise ConfigError(
            f"{most} primitives cannot fill the template '{body.name}': it needs at least "
            f"{least}, one for each segment that moves and has capsules"
        )
    transforms = body.place(body.skeleton.rest()).transforms
    clusters = [
        _cluster(segment, own, alike=alike)
        for segment, own in _carried(body.capsules, carriers, transforms).items()
    ]
    mirroring = Mirroring.of(body.skeleton)
    if mirroring is None:
        return clusters
    return _two_sided(clusters, transforms, mirroring.normal, APART * body.size)


def _carriers(body: Body) -> Indices:
    """Returns the segment to which each segment is fixed in the end, or itself, (S,)."""
    skeleton = body.skeleton
    moving = {*skeleton.ball_links.tolist(), *skeleton.hinge_links.tolist()}
    carriers = np.arange(len(skeleton.names))
    for segment, link in enumerate(skeleton.segment_links.tolist()):
        if skeleton.parents[segment] >= 0 and link not in moving:
            carriers[segment] = carriers[skeleton.parents[segment]]
    return carriers


def _carried(capsules: Capsules, carriers: Indices, transforms: Array) -> dict[int, Capsules]:
    """Returns the capsules that each segment carries, in its frame.

    Args:
        capsules: Capsules in the frames of their own segments.
        carriers: The segment that carries those of each segment, (S,).
        transforms: T_world_segment, (S, 4, 4).
    """
    owners = carriers[capsules.segments]
    found = {}
    for segment in np.unique(owners).tolist():
        into = inverse(transforms[segment]) @ transforms
        found[segment] = capsules.selected(owners == segment).place(into)
    return found


def _cluster(segment: int, capsules: Capsules, *, alike: bool) -> Cluster:
    """Returns the cluster of the points inside a segment's capsules, in its frame."""
    spacing = spacing_of(capsules, POINTS)
    points = points_inside(capsules, spacing)
    return Cluster(segment, points, 1.0 / len(points) if alike else spacing**3, None, MIRROR)


def _two_sided(
    clusters: list[Cluster], transforms: Array, normal: Array, near: float
) -> list[Cluster]:
    """Returns the clusters of the first side with their twins, of the middle, and of the rest.

    Args:
        clusters: Clusters of all segments.
        transforms: T_world_segment, (S, 4, 4).
        normal: Unit normal of the plane of symmetry, through the world's origin, (3,).
        near: Farthest distance of a segment's origin and mean from the mirror images of its twin's
            [m].
    """
    mirror = np.eye(3) - 2.0 * np.outer(normal, normal)
    means = np.array([
        transformed(transforms[one.segment], one.points.mean(axis=0)[None])[0] for one in clusters
    ])  # fmt: skip
    origins = transforms[[one.segment for one in clusters], :3, 3]
    gaps = np.max(
        [np.linalg.norm((at @ mirror)[:, None] - at, axis=2) for at in (origins, means)], axis=0
    )
    nearest = gaps.argmin(axis=1).tolist()
    found = []
    for index, (one, other) in enumerate(zip(clusters, nearest, strict=True)):
        if nearest[other] != index or gaps[index, other] > near:
            found.append(one)
            continue
        twin = clusters[other].segment
        rotations = transforms[twin, :3, :3], transforms[one.segment, :3, :3]
        with_twin = one.with_twin(twin, rotations[0].T @ mirror @ rotations[1])
        if other == index:
            central = with_twin.in_the_middle()
            share = len(central.points) / len(one.points)
            found.append(central if abs(share - 0.5) < LOPSIDED else one)
        elif other > index:
            found.append(with_twin)
    return found
