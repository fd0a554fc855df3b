"""The finder: poses of a body that may explain a frame, sought among its exemplars."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property

import numpy as np

from regkit.body import Body
from regkit.search.exemplars.atlas import SPACING, Atlas
from regkit.search.exemplars.exemplar import Exemplar
from regkit.search.exemplars.lookup import Matches, cut_matches, matches
from regkit.search.exemplars.model import Spheres
from regkit.search.exemplars.pictures import Pictures
from regkit.search.exemplars.refinement import refined
from regkit.search.exemplars.rendering import disagreements
from regkit.search.exemplars.variation import BRIEF, Variation, varied
from regkit.skeleton import Placement, Pose
from regkit.system.arrays import Array, Indices

ROUGH, SHARP = 0.10, 0.05
"""Depth difference that counts as none agreeing, before and after the refinement [size]."""

SAME = 0.06
"""Poses whose markers differ less than this on average are the same [size]."""

POINTS = 220
"""Number of points that refine a pose."""

CUT = 2
"""Factor of the number of exemplars that are looked up at each border that cuts the data off."""

SCALES = np.array([0.08] * 3 + [0.05] * 3 + [0.03] * 4)
"""Scale of the robust distances in each step of the refinement [size]."""

SPRINGS = np.array([0.3] * 3 + [0.1] * 3 + [0.03] * 4)
"""Stiffness of the joints in each of these steps."""


@dataclass(frozen=True)
class Finder:
    """Seeks a body among its exemplars.

    Attributes:
        bodies: The body at each of its sizes.
        atlas: The atlas of the template.
        rolls: Rolls of the body against its exemplars that are tried, (R,) [rad].
        looked_up: Number of exemplars that are rendered.
        kept: Number of these that are refined.
        cut_atlas: The atlas of bodies that a picture shows in part; None if none is sought.
        variation: How much the refined poses are varied.
    """

    bodies: Sequence[Body]
    atlas: Atlas
    rolls: Array
    looked_up: int
    kept: int
    cut_atlas: Atlas | None = None
    variation: Variation = BRIEF

    def candidates(self, pictures: Pictures) -> list[Exemplar]:
        """Returns the refined poses, the one that agrees best with the data first."""
        sizes = [body.size for body in self.bodies]
        count = -(-self.looked_up // (len(sizes) * len(pictures.pictures)))
        found = matches(self.atlas, pictures, sizes, self.rolls, count)
        if self.cut_atlas is not None and pictures.cut:
            cut = cut_matches(self.cut_atlas, pictures, sizes, CUT * count)
            found = Matches.joined([found, cut])
        candidates = self._best(found, self.kept, pictures)
        random = np.random.default_rng(0)
        for _ in range(self.variation.rounds):
            variants = self._variants(candidates, random)
            candidates += self._best(variants, self.variation.kept, pictures)
            candidates.sort(key=_disagreement)
        return candidates

    def disagreement(self, body: Body, pose: Pose, pictures: Pictures) -> float:
        """Returns the disagreement of a pose with the data, from 0 to 1."""
        links = body.place(pose).links[None]
        return float(_rendered(body, links, self._spheres(body), pictures, SHARP)[0])

    def _best(self, found: Matches, kept: int, pictures: Pictures) -> list[Exemplar]:
        """Returns the matches that agree best with the data, refined, the best first."""
        chosen = self._distinct(found, self._scores(found, pictures), kept)
        refined = [
            self.refined(self.bodies[found.sizes[index]], self._pose(found, index), pictures)
            for index in chosen
        ]
        return sorted(refined, key=_disagreement)

    def _variants(self, candidates: Sequence[Exemplar], random: np.random.Generator) -> Matches:
        """Returns variants of the best poses, equally many of each size."""
        poses: list[Pose] = []
        sizes: list[int] = []
        for index, body in enumerate(self.bodies):
            of_size = [one.pose for one in candidates if one.body.size == body.size]
            poses += of_size[: -(-self.variation.poses // len(self.bodies))]
            sizes += [index] * (len(poses) - len(sizes))
        return varied(
            self.bodies[0], self.atlas, poses, np.array(sizes), self.variation.each, random
        )

    def _pose(self, found: Matches, index: int) -> Pose:
        return Pose(found.roots[index], found.balls[index], found.hinges[index])

    def _placed(self, found: Matches, some: Indices, body: Body) -> Array:
        """Returns T_world_link (K, L, 4, 4) of some matches of one size."""
        pose = Pose(np.eye(4), found.balls[some], found.hinges[some])
        return np.asarray(found.roots[some][:, None] @ Placement.of(body.skeleton, pose).links)

    def _scores(self, found: Matches, pictures: Pictures) -> Array:
        """Returns the disagreement (K,) of each match."""
        scores = np.ones(len(found))
        for index, body in enumerate(self.bodies):
            some = np.flatnonzero(found.sizes == index)
            if len(some):
                links = self._placed(found, some, body)
                scores[some] = _rendered(body, links, self._spheres(body), pictures, ROUGH)
        return scores

    def _distinct(self, found: Matches, scores: Array, kept: int) -> list[int]:
        """Returns the best matches that differ from each other, equally many of each size."""
        each = -(-kept // len(self.bodies))
        chosen: list[int] = []
        for index, body in enumerate(self.bodies):
            some = np.flatnonzero(found.sizes == index)
            some = some[np.argsort(scores[some])]
            transforms = self._placed(found, some, body)[:, body.skeleton.segment_links]
            places = body.markers.place(transforms)
            for _ in range(each):
                if not len(some):
                    break
                chosen.append(int(some[0]))
                other = np.linalg.norm(places - places[0], axis=2).mean(axis=1) >= SAME * body.size
                other[0] = False
                some, places = some[other], places[other]
        return chosen

    def refined(self, body: Body, pose: Pose, pictures: Pictures) -> Exemplar:
        """Returns a pose after a few steps towards the data.

        Args:
            body: One of the bodies.
            pose: The pose.
            pictures: The data.
        """
        points = pictures.points
        points = np.ascontiguousarray(points[:: max(1, len(points) // POINTS)])
        stepped = refined(
            body,
            pose,
            self._spheres(body),
            points,
            pictures.pictures[0].grid,
            SCALES * body.size,
            SPRINGS,
            1.0 if pictures.one_sided else 0.0,
            pictures.one_sided,
        )
        found = body.skeleton.limits.hinged(stepped)
        return Exemplar(body, found, self.disagreement(body, found, pictures))

    def _spheres(self, body: Body) -> Spheres:
        return self._all_spheres[body.size]

    @cached_property
    def _all_spheres(self) -> dict[float, Spheres]:
        """The spheres of each body, by its size [m]."""
        return {body.size: Spheres.of(body, SPACING * body.size) for body in self.bodies}


def _disagreement(one: Exemplar) -> float:
    return one.disagreement


def _rendered(
    body: Body, links: Array, spheres: Spheres, pictures: Pictures, tolerance: float
) -> Array:
    """Returns the mean disagreement (K,) over all pictures for T_world_link (K, L, 4, 4)."""
    total = np.zeros(len(links))
    for picture in pictures.pictures:
        placed = picture.T_camera_world @ links
        total += disagreements(
            placed, body.skeleton.segment_links, spheres, picture.grid, tolerance * body.size
        )
    return np.asarray(total / len(pictures.pictures))
