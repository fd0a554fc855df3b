"""People from all sides: two bodies, six poses, 12 headings, elevations and rolls of the camera."""

from __future__ import annotations

from dataclasses import dataclass
from functools import partial
from itertools import product

from _starts_bodies import MOTIFS, SUBJECTS, Set, motif_named, moving
from _starts_case import Case, subset
from _starts_judge import judged
from _starts_options import Options
from _starts_shots import Shots, kept
from _starts_table import header, parts, row
from _starts_views import seen, surface, view

from regkit_synthesis.recordings.scene import SR4000

HEADINGS, ELEVATIONS, ROLLS = range(0, 360, 30), (0, 30, 60), (0, 90, 180)
"""Directions of the camera [deg]: 108 views."""

WITHIN, FAR = 0.10, 0.25
"""A start is right below the first mean joint error, and far off beyond the second [m]."""


@dataclass(frozen=True)
class PersonCase(Case):
    """A person in a pose, seen from a side.

    Attributes:
        motif: Name of the motion.
        heading: Rotation of the body from the direction to the camera [deg].
        elevation: Downward pitch of the camera [deg].
        roll: Counter-clockwise rotation of the camera about its optical axis [deg].
    """

    motif: str
    heading: int
    elevation: int
    roll: int

    @property
    def name(self) -> str:
        """Returns everything that the frames depend on, in words."""
        angles = f"heading {self.heading}, elevation {self.elevation}, roll {self.roll}"
        return f"{self.subject.name}, {self.motif}, {angles}"

    def shots(self) -> Shots:
        """Returns three frames of the motion from this side."""
        return kept(f"person: {self.name}", self._rendered)

    def _rendered(self) -> Shots:
        moved = moving(self.subject.name, self.motif)
        body, poses = moved.body, [moved.poses(time) for time in motif_named(self.motif).times]
        skin = surface(body.mesh, poses)
        T_camera_ground = view(self.heading, self.elevation, self.roll, skin)
        poses = [T_camera_ground @ pose for pose in poses]
        return seen(body.mesh, body.landmarks, poses, SR4000, self.random)


def cases(chosen: Set, some: int | None = None, seed: int = 0) -> list[PersonCase]:
    """Returns all 1296 cases of a set, or a random subset of them in random order."""
    return subset(
        [
            PersonCase(subject, motif, *angles)
            for subject, motif in product(SUBJECTS[chosen], MOTIFS[chosen])
            for angles in product(HEADINGS, ELEVATIONS, ROLLS)
        ],
        some,
        seed,
    )


def figures(options: Options) -> dict[str, object]:
    """Prints the table of people, and returns its figures."""
    every = cases(options.chosen, options.some, options.seed)
    judge, unsized = partial(judged, options.start), partial(judged, options.start, sized=False)
    header("people")
    outcomes = options.mapped("people of known size", judge, every)
    known = row("size known", outcomes, WITHIN, FAR)
    unknown = row(
        "size unknown", options.mapped("people of unknown size", unsized, every), WITHIN, FAR
    )
    parts(outcomes, WITHIN)
    found: dict[str, object] = {
        "known_size_percent": known.percent,
        "unknown_size_percent": unknown.percent,
        "seconds": known.seconds,
        "seconds_unknown_size": unknown.seconds,
    }
    if known.doubted is not None:
        found |= {"silent_over_25cm": known.silent, "doubted_right_percent": known.doubted}
    return {"people": found}
