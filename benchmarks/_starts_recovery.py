"""People who leave the picture in the middle of a track, and come back turned."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from functools import partial
from itertools import product

import numpy as np
from _starts_bodies import SUBJECTS, Set, Subject, moved_by
from _starts_case import Case
from _starts_judge import bound, distances, found
from _starts_options import Options
from _starts_people import WITHIN
from _starts_shots import Shots, kept
from _starts_views import seen, surface, view

from regkit.interfaces import Past
from regkit.system.arrays import Array
from regkit.system.optional import one_thread
from regkit_synthesis.motion.config import BvhConfig, ClipConfig, KeyframesConfig, MotionConfig
from regkit_synthesis.recordings.scene import FPS, SR4000

BEFORE, BACK, LENGTH = 20, 35, 20
"""Frames before the cut; frame of the motion at which it goes on, and frames from there."""

TURNS = (60, 90, 180)
"""Rotation of the body at the cut [deg]."""

MOTIONS: Mapping[Set, Mapping[str, MotionConfig]] = {
    "development": {
        "walk": ClipConfig(name="walk", way=0.2, start=0.3),
        "dance": ClipConfig(name="dance_b", start=0.3),
        "punch": ClipConfig(name="punch", way=0.0, start=0.3),
        "squat": KeyframesConfig(name="squat", start=0.3),
    },
    "test": {
        "run": ClipConfig(name="run", way=0.0, start=0.1),
        "other dance": ClipConfig(name="dance_a", repeated=True),
        "tennis": KeyframesConfig(name="tennis"),
        "kneel": BvhConfig(name="kneel", start=5.0),
    },
}


@dataclass(frozen=True)
class TrackCase(Case):
    """A track with a cut.

    Attributes:
        chosen: The set.
        motion: Name of the motion.
        turn: Rotation of the body at the cut [deg].
    """

    chosen: Set
    motion: str
    turn: int

    @property
    def name(self) -> str:
        """Returns everything that the frames depend on, in words."""
        return f"{self.subject.name}, {self.motion}, turned by {self.turn}"

    def shots(self) -> Shots:
        """Returns the frames before and after the cut."""
        return kept(f"track with a cut: {self.name}", self._rendered)

    def _rendered(self) -> Shots:
        moved = moved_by(self.subject, MOTIONS[self.chosen][self.motion])
        before = [moved.poses(frame / FPS) for frame in range(BEFORE)]
        after = [moved.poses(frame / FPS) for frame in range(BACK, BACK + LENGTH)]
        skin = surface(moved.body.mesh, [*before, *after])
        poses = [
            view(heading, 0.0, 0.0, skin) @ pose
            for heading, part in ((0, before), (self.turn, after))
            for pose in part
        ]
        return seen(moved.body.mesh, moved.body.landmarks, poses, SR4000, self.random)


@dataclass(frozen=True)
class Recovered:
    """What became of a track.

    Attributes:
        case: The case in words.
        errors: Mean error of the joints in each frame, (T,) [m].
    """

    case: str
    errors: Array

    @property
    def at_once(self) -> bool:
        """Returns whether the first frame after the cut is right."""
        return bool(self.errors[BEFORE] < WITHIN)

    @property
    def after(self) -> int | None:
        """Returns the number of wrong frames after the cut; None if all are wrong."""
        right = np.flatnonzero(self.errors[BEFORE:] < WITHIN)
        return int(right[0]) if len(right) else None

    def __str__(self) -> str:
        """Returns a row of the table."""
        first, last = 100.0 * self.errors[[BEFORE, -1]]
        wrong = "all" if self.after is None else self.after
        worst = 100.0 * self.errors[:BEFORE].max()
        return f"| {self.case} | {worst:.1f} | {first:.1f} | {wrong} | {last:.1f} |"


def tracked(kind: str, case: TrackCase) -> Recovered:
    """Returns what becomes of a track from the start that a search finds in its first frame."""
    observations, shots = case.observations(), case.shots()
    with one_thread():
        start = found(kind, case.subject.sized(), observations[:1], shots)
        follower, past, errors = bound(start.body), Past.start(start.pose), []
        for frame, observation in enumerate(observations):
            result = follower.step(observation, past)
            past = past.followed_by(result)
            errors.append(distances(start.body, result.pose, shots, frame).mean())
    return Recovered(case.name, np.array(errors))


def cases(chosen: Set) -> list[TrackCase]:
    """Returns the 12 tracks of a set."""
    subject: Subject = SUBJECTS[chosen][0]
    return [
        TrackCase(subject, chosen, motion, turn) for motion, turn in product(MOTIONS[chosen], TURNS)
    ]


def figures(options: Options) -> dict[str, object]:
    """Prints the table of tracks with a cut, and returns its figure."""
    tracks = options.mapped("tracks", partial(tracked, options.start), cases(options.chosen))
    print(
        "\n| lost and back | worst before [cm] | first frame back [cm] | wrong frames | last [cm] |"
    )
    print("|---|--:|--:|--:|--:|")
    print("\n".join(map(str, tracks)), flush=True)
    return {"recovered_of_12": sum(track.at_once for track in tracks)}
