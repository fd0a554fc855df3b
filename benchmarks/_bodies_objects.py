"""Starts of a left hand and a can that it carries, from nothing."""

from __future__ import annotations

import time
from pathlib import Path
from typing import Any

import numpy as np

from regkit.body.verdict import Verdict
from regkit.interfaces import StartSearch, Template
from regkit_plugins.datasets.synthetic import Synthetic
from regkit_plugins.preprocessors.points import PointsPreprocessor

CAN = Path(__file__).parents[1] / "docs" / "examples" / "objects" / "can.yaml"

GESTURES = ("fists", "signs")

SIDES = {"before": -0.05, "behind": 0.05}
"""Distance of the can behind the middle of the hand, by what it is called [m]."""

EVERY = 10
"""One in so many frames is a first frame."""

RIGHT = 0.01
"""A hand's mean joint error, and the error of the can's centre, of a start that is right [m]."""


def hand_with_can(length: float, points: PointsPreprocessor) -> dict[str, float]:
    """Prints how many starts are right, and returns figures.

    Args:
        length: Length of the hand [m].
        points: Preprocessor of the frames.
    """
    free = {
        "hand": {"kind": "hand", "side": "left", "length": length},
        "can": {"kind": "file", "path": str(CAN)},
    }
    template = Template.parse(
        {"kind": "composed", "free": free}, place="benchmark", field="template"
    )
    search = StartSearch.parse(StartSearch.default(), place="benchmark", field="start")
    errors, verdicts, seconds = [], [], []
    for recording in _dataset().chosen():
        truth = recording.truth()
        assert truth is not None
        for index, frame in enumerate(recording.frames()):
            if index % EVERY:
                continue
            seen, begun = points.preprocess(frame), time.process_time()
            start = search.find(template, [seen])
            seconds.append(time.process_time() - begun)
            body = start.body
            places = body.markers.place(body.place(start.pose).transforms)
            off = {
                joint: float(np.linalg.norm(places[body.markers.names.index(joint)] - place))
                for joint, place in zip(truth.joints, truth.positions[index], strict=True)
                if joint in body.markers.names
            }
            hand = np.mean([one for joint, one in off.items() if joint.startswith("hand_")])
            errors.append([hand, off["can_centre"]])
            verdicts.append(start.verdict)
    worst = np.array(errors).max(axis=1)
    found = np.array([one is Verdict.FOUND for one in verdicts])
    figures = {
        "starts": len(worst),
        "right_percent": round(100.0 * float((worst < RIGHT).mean()), 1),
        "within_2cm_percent": round(100.0 * float((worst < 2.0 * RIGHT).mean()), 1),
        "wrong_but_found": int((found & (worst > 2.0 * RIGHT)).sum()),
        "seconds": round(float(np.median(seconds)), 1),
    }
    print(f"hand with a can: {figures}", flush=True)
    return figures


def _dataset() -> Synthetic:
    """Returns recordings of a hand that carries a can before or behind it."""

    def bodies(gesture: str, beyond: float) -> dict[str, Any]:
        return {
            "hand": {
                "body": {"kind": "hand", "side": "left"},
                "motion": {"kind": "gestures", "name": gesture, "sway_phase_deg": 120},
                "course": [
                    {"time": 0, "place": [0.06, 0, -0.03]},
                    {"time": 1.5, "place": [-0.05, 0.04, 0.02], "rotation_deg": [20, 0, -30]},
                ],
            },
            "can": {
                "body": {"kind": "cylinder", "radius": 0.025, "height": 0.13},
                "course": [{"place": [0, beyond, 0], "rotation_deg": [0, 70, 35]}],
                "carrier": "hand",
            },
        }

    takes = {
        f"{gesture}_{side}": {"bodies": bodies(gesture, beyond)}
        for gesture in GESTURES
        for side, beyond in SIDES.items()
    }
    return Synthetic.model_validate({
        "kind": "synthetic",
        "camera": "sr305",
        "noise": 0.002,
        "defaults": {"frames": 50, "view": {"place": [0, 0, 0.5]}},
        "takes": takes,
    })  # fmt: skip
