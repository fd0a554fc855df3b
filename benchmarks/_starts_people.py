"""People from all sides: two bodies, six poses, 12 headings, elevations and rolls of the camera."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, replace
from itertools import product
from math import radians

import numpy as np
from _starts_bodies import MOTIFS, SUBJECTS, Set, Subject, moving
from _starts_shots import Shots, kept

from regkit.geometry.rigid import rigid
from regkit.geometry.rotation import vector_to_matrix
from regkit.system.arrays import Array
from regkit_synthesis.bodies.landmarks import some_vertices
from regkit_synthesis.cameras.viewpoint import Viewpoint
from regkit_synthesis.recordings.scene import SR4000, Scene

HEADINGS, ELEVATIONS, ROLLS = range(0, 360, 30), (0, 30, 60), (0, 90, 180)
"""Directions of the camera [deg]: 108 views."""

PREPROCESSOR = {"kind": "points", "voxel": 0.03, "sigma": 0.01}
"""That of the accuracy benchmarks."""

WITHIN, FAR = 0.10, 0.25
"""A start is right below the first mean joint error, and far off beyond the second [m]."""


@dataclass(frozen=True)
class PersonCase:
    """A person in a pose, seen from a side.

    Attributes:
        subject: The body with its template.
        motif: Name of the motion.
        heading: Rotation of the body from the direction to the camera [deg].
        elevation: Downward pitch of the camera [deg].
        roll: Rotation of the camera about its optical axis [deg].
    """

    subject: Subject
    motif: str
    heading: int
    elevation: int
    roll: int

    preprocessor = PREPROCESSOR
    within, far = WITHIN, FAR

    @property
    def name(self) -> str:
        """Returns the name of the case."""
        view = f"heading {self.heading}, elevation {self.elevation}, roll {self.roll}"
        return f"{self.subject.name}, {self.motif}, {view}"

    def shots(self) -> Shots:
        """Returns three frames of the motion from this side; the first is the start's."""
        return kept(f"person: {self.name}", self._rendered)

    def _rendered(self) -> Shots:
        motif = {**MOTIFS["development"], **MOTIFS["test"]}[self.motif]
        moved = moving(self.subject.name, self.motif)
        poses = [moved.poses(time) for time in motif.times]
        skin = some_vertices(moved.body.mesh, np.arange(0, len(moved.body.mesh.vertices), 8))
        T_camera_ground = view(
            self.heading,
            self.elevation,
            self.roll,
            np.concatenate([skin.posed(pose) for pose in poses]),
        )
        scene = Scene(
            name=self.name,
            source="",
            licence="",
            mesh=moved.body.mesh,
            landmarks=moved.body.landmarks,
            bone_poses=lambda frame: np.asarray(T_camera_ground @ poses[round(frame)]),
            sensor=SR4000,
            frames=len(poses),
            fps=1.0,
        )
        seen = scene.rendered(lambda frame: np.random.default_rng([frame, *self.name.encode()]))
        return Shots(seen.joints, seen.truth, seen.camera, seen.depth, seen.depth_scale)


def view(heading: float, elevation: float, roll: float, surface: Array) -> Array:
    """Returns ``T_camera_ground`` (4, 4) of the nearest camera that sees a body whole.

    Args:
        heading: Rotation of the body from the direction to the camera [deg].
        elevation: Downward pitch of the camera [deg].
        roll: Rotation of the camera about its optical axis [deg].
        surface: Points of the body over time, in ground axes, (N, 3) [m].
    """
    # In a square image with the real one's height a body stays whole under all rolls.
    camera, side = SR4000.camera, SR4000.camera.height
    square = replace(camera, width=side, cx=camera.cy)
    level = Viewpoint(heading_deg=heading, elevation_deg=elevation)
    rolled = vector_to_matrix(np.array([0.0, 0.0, radians(roll)]))
    return np.asarray(rigid(rolled, np.zeros(3)) @ level.placed(square, lambda: surface))


def cases(chosen: Set, some: int | None = None, seed: int = 0) -> Iterator[PersonCase]:
    """Yields all cases of a set, or a random subset in random order.

    Args:
        chosen: The set.
        some: Number of cases; by default all.
        seed: Seed of the choice.
    """
    every = [
        PersonCase(subject, motif, *angles)
        for subject, motif in product(SUBJECTS[chosen], MOTIFS[chosen])
        for angles in product(HEADINGS, ELEVATIONS, ROLLS)
    ]
    if some is None:
        yield from every
        return
    order = np.random.default_rng(seed).permutation(len(every))
    yield from (every[index] for index in order[:some])
