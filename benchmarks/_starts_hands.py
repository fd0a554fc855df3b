"""Hands in random orientations, alone before a camera of coded light, some with a forearm."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from functools import partial
from typing import Any, ClassVar, Literal

import numpy as np
from _starts_bodies import Set, Subject
from _starts_case import Case, subset
from _starts_judge import judged
from _starts_options import Options
from _starts_shots import Shots, kept
from _starts_table import header, row
from _starts_views import random_rotations, seen

from regkit.body import BodyDescription
from regkit.body.reading import description_in
from regkit.config.plugin import register
from regkit.geometry.rigid import rigid
from regkit.system.arrays import Array
from regkit.system.cache import cache_folder
from regkit_plugins.templates.hand import Hand
from regkit_plugins.templates.hand import with_forearm as with_part
from regkit_synthesis import assets
from regkit_synthesis.bodies.forearm import with_forearm
from regkit_synthesis.bodies.hand import HandBody
from regkit_synthesis.hands.config import GesturesConfig
from regkit_synthesis.recordings.scene import SR305
from regkit_synthesis.templates import right_hand_template
from regkit_synthesis.viewpoint import Viewpoint

ORIENTATIONS = 60
"""Number of orientations, the same for all gestures of a set."""

AWAY = 0.4
"""Distance of the hand's middle to the camera [m]."""

WITHIN, FAR = 0.01, 0.03
"""A start is right below the first mean joint error, and far off beyond the second [m]."""
FOREARM = (0.02, 0.12)
"""Least and greatest length of a forearm [m]."""

FLEXION, DEVIATION = np.radians([-50.0, 50.0]), np.radians([-15.0, 25.0])
"""Range of the wrist's angles."""

_CURLED = {"opened": 0.12, "thumb_lift_deg": 20}
"""Without these the mesh's fingertips go into its palm, as the shipped gestures say."""

GESTURES: Mapping[Set, tuple[tuple[Mapping[str, Any], ...], ...]] = {
    "development": (
        ({"pose": "handywork/flat"},),
        ({"pose": "handywork/relax"},),
        ({"pose": "handywork/vulcan"},),
        ({"pose": "handywork/shaka", "opened": 0.12},),
        ({"pose": "handywork/point", "opened": 0.12},),
        ({"pose": "handywork/horns", **_CURLED},),
        ({"pose": "handywork/fist", **_CURLED},),
        ({"pose": "iwer/relaxed"},),
        ({"pose": "iwer/point"},),
        ({"pose": "iwer/pinch", "thumb_lift_deg": 8},),
    ),
    # Midway between two poses each.
    "test": (
        ({"pose": "handywork/flat"}, {"pose": "handywork/relax"}),
        ({"pose": "handywork/flat"}, {"pose": "iwer/point"}),
        ({"pose": "handywork/relax"}, {"pose": "handywork/fist", **_CURLED}),
        ({"pose": "handywork/vulcan"}, {"pose": "handywork/point", "opened": 0.12}),
        ({"pose": "handywork/vulcan"}, {"pose": "iwer/relaxed"}),
        ({"pose": "handywork/shaka", "opened": 0.12}, {"pose": "handywork/flat"}),
        ({"pose": "handywork/horns", **_CURLED}, {"pose": "handywork/vulcan"}),
        ({"pose": "handywork/horns", **_CURLED}, {"pose": "iwer/relaxed"}),
        ({"pose": "iwer/pinch", "thumb_lift_deg": 8}, {"pose": "handywork/flat"}),
        ({"pose": "iwer/pinch", "thumb_lift_deg": 8}, {"pose": "handywork/fist", **_CURLED}),
    ),
}


@register
class SlimHand(Hand):
    """The slim hand's own template, made on first use in half a minute."""

    kind: Literal["slim_hand"] = "slim_hand"

    def description(self) -> BodyDescription:
        """Returns the description, with the shipped forearm, of another hand's width, if chosen."""
        file = cache_folder() / "benchmarks" / "slim_hand.yaml"
        if not file.is_file():
            file.parent.mkdir(parents=True, exist_ok=True)
            right_hand_template(assets.slim_hand(), "A slim right hand", "a slim hand").write(file)
        hand = description_in(file)
        return with_part(hand) if self.forearm else hand


SUBJECTS: Mapping[Set, Subject] = {
    "development": Subject("average hand", assets.average_hand, {"kind": "hand"}, "length", 0.1858),
    "test": Subject("slim hand", assets.slim_hand, {"kind": "slim_hand"}, "length", 0.1938),
}


@dataclass(frozen=True)
class HandCase(Case):
    """A hand in an orientation.

    Attributes:
        chosen: The set.
        gesture: Index of the gesture in the set.
        orientation: Index of the orientation.
        forearm: Whether a piece of the forearm is seen.
    """

    chosen: Set
    gesture: int
    orientation: int
    forearm: bool = False

    preprocessor: ClassVar[dict[str, Any]] = {"kind": "points", "voxel": 0.008, "sigma": 0.003}

    @property
    def name(self) -> str:
        """Returns everything that the frames depend on, in words."""
        poses = GESTURES[self.chosen][self.gesture]
        part = "forearm" if self.forearm else "wrist closed"
        return f"{self.subject.name}, {poses}, orientation {self.orientation}, {part}"

    def shots(self) -> Shots:
        """Returns one frame."""
        return kept(f"hand: {self.name}", self._rendered)

    def _rendered(self) -> Shots:
        random, length, bend = self.random(1), 0.0, (0.0, 0.0)
        if self.forearm:
            length = random.uniform(*FOREARM)
            bend = random.uniform(*FLEXION), random.uniform(*DEVIATION)
        body = HandBody(with_forearm(self.subject.mesh(), length, *bend))
        poses = GESTURES[self.chosen][self.gesture]
        timed = [{"time": float(time), **pose} for time, pose in enumerate((poses[0], poses[-1]))]
        moved = body.moved_by(GesturesConfig.model_validate({"poses": timed, "sway": 0.0}))
        T_camera_hand = self._placed() @ moved(0.5)
        return seen(body.mesh, body.landmarks, [T_camera_hand], SR305, self.random)

    def _placed(self) -> Array:
        """Returns ``T_camera_ground`` (4, 4), with the turned hand's middle before the camera."""
        before = Viewpoint(place=(0.0, 0.0, AWAY)).placed(SR305.camera, lambda: np.zeros((0, 3)))
        seed = {"development": 0, "test": 1}[self.chosen]
        turn = random_rotations(ORIENTATIONS, seed)[self.orientation]
        return np.asarray(before @ rigid(turn, np.zeros(3)))


def cases(
    chosen: Set, some: int | None = None, seed: int = 0, *, forearm: bool = False
) -> list[HandCase]:
    """Returns all 600 cases of a set, or a random subset of them in random order.

    Args:
        chosen: The set.
        some: Number of cases of a subset.
        seed: Seed of the subset.
        forearm: Whether a piece of the forearm is in view.
    """
    every = [
        HandCase(SUBJECTS[chosen], chosen, gesture, orientation, forearm)
        for gesture in range(len(GESTURES[chosen]))
        for orientation in range(ORIENTATIONS)
    ]
    return subset(every, some, seed)


def figures(options: Options) -> dict[str, object]:
    """Prints the table of hands, and returns its figures."""
    every = cases(options.chosen, options.some, options.seed)
    header("hands")
    outcomes = options.mapped("hands", partial(judged, options.start), every)
    known = row("size known", outcomes, WITHIN, FAR)
    longer = cases(options.chosen, options.some, options.seed, forearm=True)
    with_forearm_seen = row(
        "with a piece of the forearm",
        options.mapped("hands with a forearm", partial(judged, options.start), longer),
        WITHIN,
        FAR,
    )
    for number in range(len(GESTURES[options.chosen])):
        of_gesture = [
            one for case, one in zip(every, outcomes, strict=True) if case.gesture == number
        ]
        if of_gesture:
            poses = " to ".join(one["pose"] for one in GESTURES[options.chosen][number])
            row(poses, of_gesture, WITHIN, FAR)
    found: dict[str, object] = {
        "within_1cm_percent": known.percent,
        "with_forearm_within_1cm_percent": with_forearm_seen.percent,
        "seconds": known.seconds,
    }
    if known.doubted is not None:
        found |= {"silent_over_3cm": known.silent, "doubted_right_percent": known.doubted}
    return {"hands": found}
