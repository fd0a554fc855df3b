"""How many primitives stand for a body, and where: one for each capsule, or any number."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TypeVar

import numpy as np

from regkit.body import Body, Mirror, ShapeParameters, of_capsules
from regkit.body.freedoms import MIRROR
from regkit.system.errors import ConfigError
from regkit.tuning.layout.clusters import Cluster, Division
from regkit.tuning.layout.segment_clusters import segment_clusters

P = TypeVar("P", bound=ShapeParameters)


def one_per_capsule(body: Body, made: type[P]) -> dict[str, tuple[P, ...]]:
    """Returns a primitive for each capsule of a body, by segment, as a template lists them.

    Args:
        body: The body, at the size of its template.
        made: Class of the primitives' parameters.

    Raises:
        ConfigError: If the body has no capsules.
    """
    if not len(body.capsules):
        raise ConfigError(
            f"the template '{body.name}' has no capsules, for which primitives could stand; give "
            "its segments capsules"
        )
    listed: dict[int, list[P]] = {}
    solids = of_capsules(body.capsules, made)
    for segment, one in zip(solids.segments.tolist(), solids.parameters, strict=True):
        listed.setdefault(segment, []).append(one)
    return _by_name(body, listed)


def divided(
    body: Body, made: type[P], count: int, *, alike: bool = False
) -> dict[str, tuple[P, ...]]:
    """Returns ``count`` primitives that fill a body, by segment, as a template lists them.

    Each segment with capsules has one primitive at first, fitted to points that fill its capsules
    evenly. Then the points of one primitive after the other are divided in two, each time those for
    which this reduces the sum of their squared distances to the means the most.

    The primitives of a two-sided body are mirror images: those of both sides are divided together,
    and those in the middle into two in the middle or into one on each side. A body with nothing in
    the middle has an even number of primitives, one less than an odd ``count``.

    If there are fewer primitives than segments with capsules, a segment that is fixed to another,
    such as a person's hand to the forearm, has none of its own, and the other's fill both.

    Args:
        body: The body, at the size of its template.
        made: Class of the primitives' parameters.
        count: Number of primitives.
        alike: Whether the points of all segments count as much, so that thin ones have more
            primitives, instead of by their volume.

    Raises:
        ConfigError: If the body has no capsules, needs more primitives, or cannot be divided into
            as many.
    """
    clusters = segment_clusters(body, count, alike=alike)
    missing = count - sum(one.primitives for one in clusters)
    if missing % 2 and all(one.primitives == 2 for one in clusters):
        missing -= 1
    while missing > 0:
        found = _best(clusters, missing)
        if found is None:
            raise ConfigError(
                f"the template '{body.name}' cannot be divided into {count} primitives, but into "
                f"at most {count - missing}; take fewer"
            )
        at, division = found
        missing -= division.cost
        clusters[at : at + 1] = division.parts
    return _by_name(body, _fitted(made, clusters))


def _best(clusters: Sequence[Cluster], missing: int) -> tuple[int, Division] | None:
    """Returns the cluster whose division gains the most, and that; None if there is none.

    An odd number of missing primitives needs a cluster without another one as its mirror image.
    """
    single = sum(one.primitives == 1 for one in clusters)
    best: tuple[int, Division] | None = None
    for at, one in enumerate(clusters):
        for division in one.divisions:
            others = single - (one.primitives == 1)
            others += sum(part.primitives == 1 for part in division.parts)
            left = missing - division.cost
            possible = left >= 0 and (left % 2 == 0 or others > 0)
            if possible and (best is None or division.gain > best[1].gain):
                best = at, division
    return best


def _fitted(made: type[P], clusters: Sequence[Cluster]) -> dict[int, list[P]]:
    """Returns the primitives that are fitted to clusters, by index of the segment."""
    listed: dict[int, list[P]] = {}
    for one in clusters:
        own = listed.setdefault(one.segment, [])
        if one.middle:
            own.append(made.fitted(np.concatenate([one.points, one.mirrored])))
            continue
        own.append(made.fitted(one.points))
        if one.twin is not None:
            # The mirror image is exact where frames are parallel, as in the shipped templates.
            parallel = np.allclose(one.reflection, MIRROR, atol=1e-9)
            image = own[-1].deformed(Mirror()) if parallel else made.fitted(one.mirrored)
            listed.setdefault(one.twin, []).append(image)
    return listed


def _by_name(body: Body, listed: dict[int, list[P]]) -> dict[str, tuple[P, ...]]:
    return {body.skeleton.names[segment]: tuple(listed[segment]) for segment in sorted(listed)}
