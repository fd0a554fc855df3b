"""The finder: poses of a body that may explain a frame, sought among its exemplars."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from regkit.body import Body
from regkit.search.exemplars.atlas import SPACING, Atlas
from regkit.search.exemplars.lookup import Matches, matches
from regkit.search.exemplars.model import Bones, Hull, Spheres
from regkit.search.exemplars.pictures import Pictures
from regkit.search.exemplars.refinement import refined
from regkit.search.exemplars.rendering import disagreements
from regkit.skeleton import Placement, Pose
from regkit.system.arrays import Array, Indices

ROUGH, SHARP = 0.10, 0.05
"""Depth difference that counts as none agreeing, before and after the refinement [size]."""

SAME = 0.06
"""Poses whose markers differ less than this on average are the same [size]."""

POINTS = 220
"""Number of points that refine a pose."""

SCALES = np.array([0.08] * 3 + [0.05] * 3 + [0.03] * 4)
"""Scale of the robust distances in each step of the refinement [size]."""

SPRINGS = np.array([0.3] * 3 + [0.1] * 3 + [0.03] * 4)
"""Stiffness of the joints in each of these steps."""


@dataclass(frozen=True)
class Exemplar:
    """A pose that may explain a frame.

    Attributes:
        body: The body at a size.
        pose: Its pose.
        disagreement: Disagreement of the rendered body with the data, from 0 to 1.
    """

    body: Body
    pose: Pose
    disagreement: float


@dataclass(frozen=True)
class Finder:
    """Seeks a body among its exemplars.

    Attributes:
        bodies: The body at each of its sizes.
        atlas: The atlas of the template.
        rolls: Rolls of the body against its exemplars that are tried, (R,) [rad].
        looked_up: Number of exemplars that are rendered.
        refined: Number of these that are refined.
    """

    bodies: Sequence[Body]
    atlas: Atlas
    rolls: Array
    looked_up: int
    refined: int

    def candidates(self, pictures: Pictures) -> list[Exemplar]:
        """Returns the refined poses, the one that agrees best with the data first."""
        sizes = [body.size for body in self.bodies]
        count = -(-self.looked_up // (len(sizes) * len(pictures.pictures)))
        found = matches(self.atlas, pictures, sizes, self.rolls, count)
        scores = self._scores(found, pictures)
        points = pictures.points
        some = np.ascontiguousarray(points[:: max(1, len(points) // POINTS)])
        candidates = [
            self._refined(self.bodies[found.sizes[index]], self._pose(found, index), some, pictures)
            for index in self._distinct(found, scores)
        ]
        return sorted(candidates, key=lambda candidate: candidate.disagreement)

    def disagreement(self, body: Body, pose: Pose, pictures: Pictures) -> float:
        """Returns the disagreement of a pose with the data, from 0 to 1."""
        links = body.place(pose).links[None]
        return float(_rendered(body, links, pictures, SHARP)[0])

    def _pose(self, found: Matches, index: int) -> Pose:
        exemplar = found.exemplars[index]
        balls, hinges = self.atlas.balls[exemplar], self.atlas.hinges[exemplar]
        return Pose(found.roots[index], balls.astype(float), hinges.astype(float))

    def _placed(self, found: Matches, some: Indices, body: Body) -> Array:
        """Returns T_world_link (K, L, 4, 4) of some matches of one size."""
        chosen = found.exemplars[some]
        balls, hinges = self.atlas.balls[chosen], self.atlas.hinges[chosen]
        pose = Pose(np.eye(4), balls.astype(float), hinges.astype(float))
        return np.asarray(found.roots[some][:, None] @ Placement.of(body.skeleton, pose).links)

    def _scores(self, found: Matches, pictures: Pictures) -> Array:
        """Returns the disagreement (K,) of each match."""
        scores = np.ones(len(found))
        for index, body in enumerate(self.bodies):
            some = np.flatnonzero(found.sizes == index)
            if len(some):
                links = self._placed(found, some, body)
                scores[some] = _rendered(body, links, pictures, ROUGH)
        return scores

    def _distinct(self, found: Matches, scores: Array) -> list[int]:
        """Returns the best matches that differ from each other, equally many of each size."""
        most = -(-self.refined // len(self.bodies))
        chosen: list[int] = []
        for index, body in enumerate(self.bodies):
            some = np.flatnonzero(found.sizes == index)
            if not len(some):
                continue
            some = some[np.argsort(scores[some])]
            transforms = self._placed(found, some, body)[:, body.skeleton.segment_links]
            places = np.stack([body.markers.place(one) for one in transforms])
            left = np.ones(len(some), dtype=bool)
            for row in range(len(some)):
                if left[row] and most > 0:
                    gaps = np.linalg.norm(places - places[row], axis=2).mean(axis=1)
                    left &= gaps >= SAME * body.size
                    chosen.append(int(some[row]))
                    most -= 1
            most = -(-self.refined // len(self.bodies))
        return chosen

    def _refined(self, body: Body, pose: Pose, points: Array, pictures: Pictures) -> Exemplar:
        root, balls, hinges = refined(
            pose.root,
            pose.balls,
            pose.hinges,
            Bones.of(body),
            Hull.of(body),
            _spheres(body),
            points,
            pictures.pictures[0].grid,
            SCALES * body.size,
            SPRINGS,
            1.0 if pictures.one_sided else 0.0,
            pictures.one_sided,
        )
        found = body.skeleton.limits.hinged(Pose(root, balls, hinges))
        return Exemplar(body, found, self.disagreement(body, found, pictures))


def _spheres(body: Body) -> Spheres:
    return Spheres.of(body, SPACING * body.size)


def _rendered(body: Body, links: Array, pictures: Pictures, tolerance: float) -> Array:
    """Returns the mean disagreement (K,) over all pictures for T_world_link (K, L, 4, 4)."""
    total, spheres = np.zeros(len(links)), _spheres(body)
    for picture in pictures.pictures:
        placed = picture.T_camera_world @ links
        total += disagreements(
            placed, body.skeleton.segment_links, spheres, picture.grid, tolerance * body.size
        )
    return np.asarray(total / len(pictures.pictures))
