"""People cut off by the border of the picture, from any side."""

from __future__ import annotations

from dataclasses import dataclass, replace
from functools import partial
from itertools import product

import numpy as np
from _starts_bodies import MOTIFS, SUBJECTS, Set, motif_named, moving
from _starts_case import subset
from _starts_judge import judged
from _starts_options import Options
from _starts_people import ELEVATIONS, FAR, HEADINGS, ROLLS, WITHIN, PersonCase
from _starts_shots import Shots, kept
from _starts_table import header, parts, row
from _starts_views import seen, surface, view

from regkit.geometry.rigid import rigid, transformed
from regkit.geometry.rotation import vector_to_matrix
from regkit.geometry.skinned_mesh import SkinnedMesh
from regkit.sensors.raycast import RayCaster
from regkit.system.arrays import Array, Indices
from regkit_synthesis.recordings.scene import SR4000

SHARES = (65, 50)
"""Percentages of the body's pixels in view."""

NEAREST = 0.7
"""The camera is at least this much nearer than one that sees the body whole, at random."""

WIDER = 4
"""Size of the picture in which the whole body is counted, relative to the camera's."""


@dataclass(frozen=True)
class CroppedCase(PersonCase):
    """A person of whom the picture shows a part.

    Attributes:
        percent: Percentage of the body's pixels in view.
    """

    percent: int

    @property
    def name(self) -> str:
        """Returns everything that the frames depend on, in words."""
        return f"{super().name}, {self.percent} % in view"

    def shots(self) -> Shots:
        """Returns one frame."""
        return kept(f"cropped person: {self.name}", self._rendered)

    def _rendered(self) -> Shots:
        moved = moving(self.subject.name, self.motif)
        body, pose = moved.body, moved.poses(motif_named(self.motif).times[0])
        whole = view(self.heading, self.elevation, self.roll, surface(body.mesh, [pose]))
        random = self.random(self.percent)
        near = np.eye(4)
        near[2, 3] = (random.uniform(NEAREST, 1.0) - 1.0) * whole[2, 3]
        pose = near @ whole @ pose
        pose = _turned_away(body.mesh, pose, self.percent / 100.0, random) @ pose
        return seen(body.mesh, body.landmarks, [pose], SR4000, self.random)

    def judged_joints(self) -> Indices:
        """Returns the joints in the picture; the others are not seen."""
        shots, camera = self.shots(), SR4000.camera
        column, line = camera.projected(shots.truth[0]).T
        inside = (column > 0) & (column < camera.width) & (line > 0) & (line < camera.height)
        return np.flatnonzero(inside)


def _turned_away(
    mesh: SkinnedMesh, pose: Array, share: float, random: np.random.Generator
) -> Array:
    """Returns the turn (4, 4) of a camera after which a share of the body's pixels is in view.

    Args:
        mesh: The body.
        pose: Bone poses ``T_camera_bone`` (J, 4, 4) before a camera that looks at its middle.
        share: The share.
        random: Source of the direction.
    """
    camera = SR4000.camera
    wide = replace(
        camera,
        width=WIDER * camera.width,
        height=WIDER * camera.height,
        cx=WIDER * camera.width / 2.0,
        cy=WIDER * camera.height / 2.0,
    )
    points = wide.back_projected(RayCaster(wide).view(mesh.posed(pose), mesh.faces).depth)
    angle = random.uniform(0.0, 2.0 * np.pi)
    axis = np.array([np.cos(angle), np.sin(angle), 0.0])

    def turned(by: float) -> Array:
        return rigid(vector_to_matrix(by * axis), np.zeros(3))

    low, high = 0.0, 0.8
    for _ in range(20):
        middle = (low + high) / 2.0
        low, high = (
            (middle, high)
            if _in_view(transformed(turned(middle), points)) > share
            else (low, middle)
        )
    return turned(low)


def _in_view(points: Array) -> float:
    """Returns the share of points (N, 3) [m] in the camera's picture."""
    camera = SR4000.camera
    column, line = np.rint(camera.projected(points[points[:, 2] > 0.1])).T
    inside = (column >= 0) & (column < camera.width) & (line >= 0) & (line < camera.height)
    return float(inside.sum() / len(points))


def cases(chosen: Set, percent: int, some: int | None = None, seed: int = 0) -> list[CroppedCase]:
    """Returns all 1296 cases of a set and a percentage, or a random subset of them."""
    every = [
        CroppedCase(subject, motif, *angles, percent)
        for subject, motif in product(SUBJECTS[chosen], MOTIFS[chosen])
        for angles in product(HEADINGS, ELEVATIONS, ROLLS)
    ]
    return subset(every, some, seed)


def figures(options: Options) -> dict[str, object]:
    """Prints the table of people who are cut off, and returns its figures."""
    header("people cut off")
    found: dict[str, object] = {}
    for percent in SHARES:
        every = cases(options.chosen, percent, options.some, options.seed)
        outcomes = options.mapped("people cut off", partial(judged, options.start), every)
        found[str(percent)] = row(f"{percent} % in view", outcomes, WITHIN, FAR).percent
    parts(outcomes, WITHIN)
    return {"cropped": found}
