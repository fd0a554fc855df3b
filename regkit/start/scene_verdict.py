"""The verdict of a start of several bodies: the worst of theirs, with the names of the bodies."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from itertools import combinations

import numpy as np
from numpy.typing import NDArray

from regkit.body import Body, BodyFit
from regkit.body.each import gaps_to_each
from regkit.body.fit import tolerance
from regkit.body.verdict import Verdict, frame_verdict, worst
from regkit.interfaces import Start
from regkit.observation import Sight
from regkit.skeleton import Pose
from regkit.start.scene import Scene
from regkit.start.several import FEWEST, SeveralSearch
from regkit.start.verdict import SURE_MARGIN, judged
from regkit.system.arrays import Array

LONG = 1.3
"""No body explains points that extend over more than this, in sizes of the body."""

SEEN = 0.4
"""A body of which the data show less is doubtful: how the hidden part is posed is a guess.

Of 13 starts of hands one before the other, 6 are more than 1.4 cm off; this doubts 5 of them, and 2
of the 7 others.
"""

AS_MANY = 0.05
"""It explains them as well if it has at most this much smaller a share of inliers than both."""


def judged_scene(scenes: Sequence[Scene], search: SeveralSearch) -> Start:
    """Returns the start of a scene, found if each of its bodies is.

    Args:
        scenes: The best scene, and the best one in which bodies are exchanged, if there is one.
        search: The search.
    """
    scene, *rivals = scenes
    told = list(_of_bodies(scene, search)) + list(_of_pairs(scene, search))
    margin = float("nan")
    for rival in rivals:
        # Costs are means over the points of all bodies, of which a few decide.
        margin = len(search.templates) * (rival.cost - scene.cost)
        if margin < SURE_MARGIN:
            told.append((Verdict.DOUBTFUL, "the bodies, exchanged, fit nearly as well"))
    verdict = worst(one for one, _ in told)
    reason = "; ".join(reason for _, reason in told if reason)
    return Start(scene.body, scene.pose, verdict, reason, margin)


def _of_bodies(scene: Scene, search: SeveralSearch) -> Iterator[tuple[Verdict, str]]:
    """Yields the verdict of each body on its own points, with the reason."""
    each = zip(scene.body.free_bodies, scene.owned(search.observation), scene.starts, strict=True)
    for one, own, start in each:
        if own.sum() < FEWEST:
            yield Verdict.LOST, f"{one.name}: only {own.sum()} points are nearest to it"
            continue
        seen = search.observation.only(own)
        doubts = _hidden(one.body, one.alone(scene.pose), search.observation.sight)
        found = judged(one.body, one.alone(scene.pose), seen, start.margin, doubts)
        yield found.verdict, f"{one.name}: {found.reason}" if found.reason else ""


def _hidden(body: Body, pose: Pose, sight: Sight | None) -> list[str]:
    """Returns in words that most of a body is hidden, by others or by itself."""
    if sight is None or not len(body.capsules):
        return []
    axes = body.required_axes
    spheres = axes.place(body.place(pose).transforms)
    shown = float(sight.observable(spheres, axes.radii + body.limb_radius).mean())
    return [] if shown >= SEEN else [f"{100.0 * (1.0 - shown):.0f} % of it are hidden"]


def _of_pairs(scene: Scene, search: SeveralSearch) -> Iterator[tuple[Verdict, str]]:
    """Yields a verdict for each body whose points another explains alone."""
    points, bodies = search.observation.points, scene.body.free_bodies
    owned = scene.owned(search.observation)
    for pair in combinations(range(len(bodies)), 2):
        both = owned[pair[0]] | owned[pair[1]]
        size = max(bodies[at].body.size for at in pair)
        # A body without points of its own has been judged.
        if not all(owned[at].any() for at in pair) or _length(points[both]) > LONG * size:
            continue
        share = _explained(scene, pair, points[both])
        enough = [at for at in pair if _explains_alone(search, at, both, share)]
        if enough:
            alone = min(enough, key=lambda at: search.alone(at, both)[1])
            other = next(at for at in pair if at != alone)
            told = f"{bodies[other].name}: '{bodies[alone].name}' explains its points alone"
            yield Verdict.LOST, told


def _explained(scene: Scene, pair: Sequence[int], points: Array) -> float:
    """Returns the share of points (N, 3) that lie on one of two bodies."""
    gaps = gaps_to_each(scene.body, scene.pose, points)
    bodies = [scene.body.free_bodies[at].body for at in pair]
    near = [gaps[at] <= tolerance(body) for at, body in zip(pair, bodies, strict=True)]
    return float((near[0] | near[1]).mean())


def _explains_alone(
    search: SeveralSearch, at: int, points: NDArray[np.bool_], share: float
) -> bool:
    """Returns whether a body alone is found in points, and explains a share of them."""
    start, _ = search.alone(at, points)
    seen = search.observation.only(points)
    fit = BodyFit.of(start.body, start.pose, seen.points, seen.sight)
    shares = (fit.inlier_share, fit.coverage, fit.misfit, fit.relief)
    found = frame_verdict(len(seen.points), *shares) is Verdict.FOUND
    return found and fit.inlier_share >= share - AS_MANY


def _length(points: Array) -> float:
    """Returns the extent of points (N, 3) along their longest axis [m]."""
    centred = points - points.mean(axis=0)
    axis = np.linalg.eigh(centred.T @ centred)[1][:, -1]
    return float(np.ptp(centred @ axis))
