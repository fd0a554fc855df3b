"""Full scans: points all around a body, without a camera, in any orientation."""

from __future__ import annotations

from dataclasses import dataclass
from functools import partial
from itertools import product

import numpy as np
from _starts_bodies import MOTIFS, SUBJECTS, Set, motif_named, moving
from _starts_case import Case, subset
from _starts_judge import judged
from _starts_options import Options
from _starts_people import FAR, WITHIN
from _starts_shots import Shots, kept
from _starts_table import header, row
from _starts_views import random_rotations

from regkit.geometry.rigid import rigid
from regkit.system.arrays import Array, Indices
from regkit_synthesis.bodies.landmarks import placed

POSES, ORIENTATIONS = 20, 24
"""Numbers of poses, and of orientations: upright before a camera, and random ones."""

POINTS, NOISE = 6000, 0.003
"""Number of points on the whole surface, and their standard deviation [m]."""

_UPRIGHT = np.array([[1.0, 0.0, 0.0], [0.0, 0.0, -1.0], [0.0, 1.0, 0.0]])
"""From the ground's axes (x left, y backward, z up) to x right, y down, z forward."""


@dataclass(frozen=True)
class ScanCase(Case):
    """A scanned body.

    Attributes:
        chosen: The set.
        motif: Name of the motion.
        time: Moment of the motion [s].
        orientation: Index of the orientation.
    """

    chosen: Set
    motif: str
    time: float
    orientation: int

    @property
    def name(self) -> str:
        """Returns everything that the points depend on, in words."""
        moment = f"{self.motif} at {self.time:.3f} s"
        return f"{self.subject.name}, {moment}, {self.chosen} orientation {self.orientation}"

    def shots(self) -> Shots:
        """Returns one cloud."""
        return kept(f"scan: {self.name}", self._sampled)

    def _sampled(self) -> Shots:
        moved = moving(self.subject.name, self.motif)
        mesh, random = moved.body.mesh, self.random()
        pose = rigid(self._rotation(), random.normal(size=3)) @ moved.poses(self.time)
        points = _surface_points(mesh.posed(pose), mesh.faces, random)
        points += NOISE * random.normal(size=points.shape)
        truth = placed(moved.body.landmarks, mesh, pose)
        return Shots(
            tuple(moved.body.landmarks), truth[None], clouds=points[None].astype(np.float32)
        )

    def _rotation(self) -> Array:
        if not self.orientation:
            return _UPRIGHT
        seed = {"development": 0, "test": 1}[self.chosen]
        return np.asarray(random_rotations(ORIENTATIONS, seed)[self.orientation] @ _UPRIGHT)


def _surface_points(vertices: Array, faces: Indices, random: np.random.Generator) -> Array:
    """Returns points (N, 3) [m], uniformly distributed on a mesh."""
    a, b, c = np.moveaxis(vertices[faces], 1, 0)
    areas = np.linalg.norm(np.cross(b - a, c - a), axis=1)
    chosen = random.choice(len(faces), POINTS, p=areas / areas.sum())
    u, v = random.uniform(size=(2, POINTS, 1))
    u, v = np.where(u + v > 1.0, 1.0 - u, u), np.where(u + v > 1.0, 1.0 - v, v)
    return np.asarray(a[chosen] + u * (b - a)[chosen] + v * (c - a)[chosen])


def cases(chosen: Set, some: int | None = None, seed: int = 0) -> list[ScanCase]:
    """Returns all 480 cases of a set, or a random subset of them in random order."""
    poses = product(range(4), enumerate(MOTIFS[chosen]))
    every = [
        ScanCase(
            SUBJECTS[chosen][(number + quarter) % 2],
            chosen,
            motif,
            _moment(motif, quarter),
            orientation,
        )
        for quarter, (number, motif) in list(poses)[:POSES]
        for orientation in range(ORIENTATIONS)
    ]
    return subset(every, some, seed)


def _moment(motif: str, quarter: int) -> float:
    """Returns one of four moments, spread over a motion's part that the set uses [s]."""
    times = motif_named(motif).times
    first, last = min(times), max(times)
    return first + quarter / 3.0 * (last - first)


def figures(options: Options) -> dict[str, object]:
    """Prints the table of scans, and returns its figure."""
    every = cases(options.chosen, options.some, options.seed)
    header("full scans")
    outcomes = options.mapped("full scans", partial(judged, options.start), every)
    found = row("size known", outcomes, WITHIN, FAR)
    return {"scans_percent": found.percent}
