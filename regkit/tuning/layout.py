"""How many primitives stand for a body, and where: one for each capsule, or any number."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TypeVar

import numpy as np

from regkit.body import Body, Mirror, ShapeParameters, of_capsules
from regkit.body.deformation import REFLECT
from regkit.geometry.capsule_points import points_inside, spacing_of
from regkit.geometry.capsules import Capsules
from regkit.geometry.rigid import inverse
from regkit.skeleton import Mirroring
from regkit.system.arrays import Array, Indices
from regkit.system.errors import ConfigError
from regkit.tuning.clusters import Cluster

P = TypeVar("P", bound=ShapeParameters)

POINTS = 8000
"""About the number of points that fill the capsules of a segment."""

APART = 0.05
"""Farthest that the mirror image of a segment's middle is from that of its counterpart, as a
fraction of the body's size."""


def one_per_capsule(body: Body, made: type[P]) -> dict[str, tuple[P, ...]]:
    """Returns a primitive for each capsule of a body, by segment, as a template lists them.

    Args:
        body: The body, at the size of its template.
        made: Class of the primitives' parameters.

    Raises:
        ConfigError: If the body has no capsules.
    """
    _check_capsules(body)
    listed = of_capsules(body.capsules, made)
    return {
        body.skeleton.names[segment]: tuple(
            one
            for own, one in zip(listed.segments, listed.parameters, strict=True)
            if own == segment
        )
        for segment in np.unique(listed.segments)
    }


def divided(body: Body, made: type[P], count: int) -> dict[str, tuple[P, ...]]:
    """Returns ``count`` primitives that fill a body, by segment, as a template lists them.

    Each segment with capsules has one primitive at first, fitted to points that fill its capsules.
    Then the points of one primitive after the other are divided in two, each time those for which
    this reduces the squared distances to the means the most.

    The primitives of a two-sided body are mirror images: those of both sides are divided together,
    and those in the middle into two in the middle or into one on each side. If none in the middle
    is left for an odd number, the result has one primitive less.

    If there are fewer primitives than segments with capsules, a segment that is fixed to another,
    such as a person's hand to the forearm, has none of its own, and the other's fill both.

    Args:
        body: The body, at the size of its template.
        made: Class of the primitives' parameters.
        count: Number of primitives.

    Raises:
        ConfigError: If the body has no capsules, or needs more primitives, or is not as divisible.
    """
    _check_capsules(body)
    clusters = _whole(body, count)
    missing = count - sum(one.primitives for one in clusters)
    while missing > 0:
        possible = [at for at, one in enumerate(clusters) if 0 < one.division.cost <= missing]
        if not possible:
            break
        best = max(possible, key=lambda at: clusters[at].division.gain)
        missing -= clusters[best].division.cost
        clusters[best : best + 1] = clusters[best].division.parts
    if missing > 1:
        raise ConfigError(
            f"the template '{body.name}' cannot be divided into {count} primitives, but into at "
            f"most {count - missing}; take fewer"
        )
    return _fitted(body, made, clusters)


def _check_capsules(body: Body) -> None:
    """Refuses a body without capsules."""
    if not len(body.capsules):
        raise ConfigError(
            f"the template '{body.name}' has no capsules, which primitives could fill; give its "
            "segments capsules"
        )


def _whole(body: Body, count: int) -> list[Cluster]:
    """Returns one cluster for each segment with capsules, and at most ``count`` primitives.

    Raises:
        ConfigError: If that is impossible.
    """
    carriers = np.arange(len(body.skeleton.names))
    if count < len(np.unique(body.capsules.segments)):
        carriers = _carriers(body)
    least = len(np.unique(carriers[body.capsules.segments]))
    if count < least:
        raise ConfigError(
            f"{count} primitives cannot fill the template '{body.name}': it needs at least {least}, "
            "one for each segment that moves and has capsules"
        )
    transforms = body.place(body.skeleton.rest()).transforms
    placed = _carried(body.capsules.place(transforms), carriers)
    flesh = {}
    for segment in np.unique(placed.segments).tolist():
        own = placed.selected(placed.segments == segment).place(
            np.tile(inverse(transforms[segment]), (len(transforms), 1, 1))
        )
        spacing = spacing_of(own, POINTS)
        flesh[segment] = points_inside(own, spacing), spacing**3
    normal = Mirroring.of(body.skeleton)
    twins = {} if normal is None else _twins(body, transforms, flesh, normal.normal)
    found = []
    for segment, (points, volume) in flesh.items():
        twin = twins.get(segment)
        if twin is None or normal is None:
            found.append(Cluster(segment, points, volume, None, np.diag(REFLECT)))
            continue
        if twin < segment:
            continue  # It has the mirror images of the twin's.
        mirror = np.eye(3) - 2.0 * np.outer(normal.normal, normal.normal)
        reflection = transforms[twin, :3, :3].T @ mirror @ transforms[segment, :3, :3]
        cluster = Cluster(segment, points, volume, twin, reflection)
        found.append(cluster.halved() if twin == segment else cluster)
    return found


def _carriers(body: Body) -> Indices:
    """Returns the segment to which each segment is fixed in the end, or itself, (S,)."""
    skeleton = body.skeleton
    moving = {*skeleton.ball_links.tolist(), *skeleton.hinge_links.tolist()}
    carriers = np.arange(len(skeleton.names))
    for segment, (link, parent) in enumerate(
        zip(skeleton.segment_links.tolist(), skeleton.parents.tolist(), strict=True)
    ):
        if parent >= 0 and link not in moving:
            carriers[segment] = carriers[parent]
    return carriers


def _carried(capsules: Capsules, carriers: Indices) -> Capsules:
    return Capsules(carriers[capsules.segments], capsules.ends, capsules.radii)


def _twins(
    body: Body, transforms: Array, flesh: dict[int, tuple[Array, float]], normal: Array
) -> dict[int, int]:
    """Returns the segment on the other side of each, itself in the middle, of those with one."""
    segments = list(flesh)
    middles = np.array([
        transforms[segment, :3, :3] @ points.mean(axis=0) + transforms[segment, :3, 3]
        for segment, (points, _) in flesh.items()
    ])  # fmt: skip
    images = middles - 2.0 * np.outer(middles @ normal, normal)
    gaps = np.linalg.norm(images[:, None] - middles, axis=2)
    nearest = gaps.argmin(axis=1)
    return {
        segments[one]: segments[other]
        for one, other in enumerate(nearest.tolist())
        if nearest[other] == one and gaps[one, other] < APART * body.size
    }


def _fitted(body: Body, made: type[P], clusters: Sequence[Cluster]) -> dict[str, tuple[P, ...]]:
    """Returns the primitives that are fitted to clusters, by segment."""
    listed: dict[int, list[P]] = {}
    for one in clusters:
        own = listed.setdefault(one.segment, [])
        if one.middle:
            own.append(made.fitted(np.concatenate([one.points, one.mirrored])))
            continue
        own.append(made.fitted(one.points))
        if one.twin is not None:
            # Parallel frames make the mirror image exact.
            parallel = np.allclose(one.reflection, np.diag(REFLECT), atol=1e-9)
            image = own[-1].deformed(Mirror()) if parallel else made.fitted(one.mirrored)
            listed.setdefault(one.twin, []).append(image)
    return {body.skeleton.names[segment]: tuple(listed[segment]) for segment in sorted(listed)}
