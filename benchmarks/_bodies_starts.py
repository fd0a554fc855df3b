"""Starts of two hands from nothing, which are apart, close, or one before the other."""

from __future__ import annotations

import time
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from regkit.body import Body
from regkit.body.verdict import Verdict
from regkit.interfaces import StartSearch, Template
from regkit.metrics import exchanged_frames, parts_of_markers
from regkit.skeleton import Pose
from regkit.system.arrays import Array
from regkit_plugins.datasets.synthetic import SyntheticRecording
from regkit_plugins.preprocessors.points import PointsPreprocessor

EVERY = 5
"""One in so many frames is a first frame."""

RIGHT = 0.01
"""A start is right if the mean joint error of each hand is smaller [m]."""

CLOSE = 0.03
"""Hands are close, or one is before the other, if joints of both are nearer than this in the
picture, at their mean depth [m]."""

BEFORE = 0.04
"""Of these, one is before the other if all joints of both are farther apart in space [m]."""


@dataclass(frozen=True)
class Outcome:
    """What a start reaches in a frame.

    Attributes:
        case: ``apart``, ``close`` or ``before``.
        errors: Mean joint error of each hand, (2,) [m].
        exchanged: Whether the hands are nearer to each other's places.
        verdict: The verdict of the start.
        seconds: Processor time of the search [s].
    """

    case: str
    errors: Array
    exchanged: bool
    verdict: Verdict
    seconds: float

    @property
    def right(self) -> bool:
        """Whether both hands are right."""
        return bool((self.errors < RIGHT).all()) and not self.exchanged


def starts(
    recordings: Sequence[SyntheticRecording], template: Template, points: PointsPreprocessor
) -> dict[str, object]:
    """Prints the table of starts, and returns figures.

    Args:
        recordings: Recordings of a left and a right hand.
        template: The template of both.
        points: Preprocessor of the frames.
    """
    search = StartSearch.parse(StartSearch.default(), place="benchmark", field="start")
    found: list[Outcome] = []
    for recording in recordings:
        truth = recording.truth()
        assert truth is not None
        frames = enumerate(recording.frames())
        for index, frame in frames:
            if index % EVERY:
                continue
            seen = points.preprocess(frame)
            begun = time.process_time()
            start = search.find(template, [seen])
            seconds = time.process_time() - begun
            places = truth.positions[index]
            errors, exchanged = _errors(start.body, start.pose, truth.joints, places)
            case = _case(truth.joints, places)
            found.append(Outcome(case, errors, exchanged, start.verdict, seconds))
    print(f"\n{'starts':<10}{'frames':>8}{'right %':>9}{'in 2 cm %':>11}{'kept %':>8}"
          f"{'found %':>9}{'wrong, found':>14}{'mm':>7}{'s':>7}")  # fmt: skip
    cases = {case: [one for one in found if one.case == case] for case in CASES}
    return {case: _told(case, some) for case, some in {**cases, "all": found}.items() if some}


CASES = ("apart", "close", "before")


def _told(case: str, some: Sequence[Outcome]) -> dict[str, float]:
    """Prints a row; returns its figures."""
    figures = {
        "frames": len(some),
        "right_percent": _percent([one.right for one in some]),
        "within_2cm_percent": _percent([bool((one.errors < 2.0 * RIGHT).all()) for one in some]),
        "identities_percent": _percent([not one.exchanged for one in some]),
        "found_percent": _percent([one.verdict is Verdict.FOUND for one in some]),
        "wrong_but_found": sum(
            one.verdict is Verdict.FOUND and bool((one.errors > 2.0 * RIGHT).any()) for one in some
        ),
        "mm": round(1e3 * float(np.median([one.errors.mean() for one in some])), 2),
        "seconds": round(float(np.median([one.seconds for one in some])), 1),
    }
    widths = (8, 9, 11, 8, 9, 14, 7, 7)
    cells = (f"{value:>{width}}" for value, width in zip(figures.values(), widths, strict=True))
    print(f"{case:<10}" + "".join(cells), flush=True)
    return figures


def _percent(several: Sequence[bool]) -> float:
    return round(100.0 * float(np.mean(several)), 1)


def _errors(body: Body, pose: Pose, joints: Sequence[str], truth: Array) -> tuple[Array, bool]:
    """Returns the mean joint error of each hand, (2,) [m], and whether they are exchanged."""
    places = body.markers.place(body.place(pose).transforms)
    order = [body.markers.names.index(joint) for joint in joints]
    parts = parts_of_markers(body, order)
    errors = np.linalg.norm(places[order] - truth, axis=1)
    switched = exchanged_frames(joints, parts, places[None, order], truth[None])
    assert switched is not None
    of_part = [errors[[name == part.name for name in parts]].mean() for part in body.parts]
    return np.array(of_part), bool(switched[0])


def _case(joints: Sequence[str], places: Array) -> str:
    """Returns whether two hands are apart, close, or one before the other in the picture."""
    first = np.array([joint.startswith(joints[0].split("_")[0]) for joint in joints])
    one, other = places[first], places[~first]
    depth = float(places[:, 2].mean())
    flat = [each[:, :2] / each[:, 2:] * depth for each in (one, other)]
    beside = np.linalg.norm(flat[0][:, None] - flat[1], axis=2).min()
    if beside > CLOSE:
        return "apart"
    nearest = np.linalg.norm(one[:, None] - other, axis=2).min()
    return "before" if nearest > BEFORE else "close"
