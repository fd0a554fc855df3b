"""People with hands: errors of body and hands at 1 m, and of the body alone."""

from __future__ import annotations

import time
from collections.abc import Mapping
from typing import Any

import numpy as np

from regkit.interfaces import Method, Past, StartSearch, Template, Tracker
from regkit.system.arrays import Array
from regkit_plugins.datasets.synthetic import Synthetic, SyntheticRecording
from regkit_plugins.preprocessors.points import PointsPreprocessor

HEIGHTS = {"average": 1.6327, "small": 1.4901, "tall": 1.88}
"""True heights of the bodies [m]."""

HANDS = {f"{side}_hand": {"kind": "hand", "side": side} for side in ("left", "right")}


def gestures(name: str, right: str, left: str) -> dict[str, Any]:
    """Returns a body whose hands make gestures."""
    hands = {
        side: {"kind": "gestures", "name": gesture}
        for side, gesture in (("right", right), ("left", left))
    }
    return {"kind": "shipped", "name": name, "hands": hands}


TAKES: Mapping[str, dict[str, Any]] = {
    "average_front": {
        "body": gestures("average", "point_and_pinch", "signs"),
        "motion": {"kind": "keyframes", "name": "hands_forward", "start": 1.2},
    },
    "average_side": {
        "body": gestures("average", "fists", "point_and_pinch"),
        "motion": {"kind": "keyframes", "name": "hands_forward", "start": 2.0, "speed": 1.5},
        "view": {"heading_deg": 30, "distance": 1.2},
    },
    "small_above": {
        "body": gestures("small", "signs", "fists"),
        "motion": {"kind": "keyframes", "name": "hands_forward", "start": 0.4},
        "view": {"heading_deg": -15, "elevation_deg": 15, "distance": 1.2},
    },
    "tall_fast": {
        "body": gestures("tall", "signs", "point_and_pinch"),
        "motion": {"kind": "keyframes", "name": "hands_forward", "start": 0.9, "speed": 2.0},
        "view": {"heading_deg": 10, "distance": 1.35},
    },
    "average_clap": {
        "body": gestures("average", "point_and_pinch", "signs"),
        "motion": {"kind": "keyframes", "name": "clap"},
        "view": {"heading_deg": 20, "distance": 1.3},
    },
    "small_wave": {
        "body": gestures("small", "signs", "point_and_pinch"),
        "motion": {"kind": "keyframes", "name": "wave"},
        "view": {"heading_deg": -20, "distance": 1.3},
    },
    "average_far": {
        "body": gestures("average", "fists", "signs"),
        "motion": {"kind": "keyframes", "name": "hands_forward", "start": 0.6},
        "view": {"heading_deg": 15, "distance": 11.0},
        "frames": 30,
    },
}
"""Takes that no choice was made on."""

FAR = "average_far"
"""The take in which a hand has some ten pixels; it is not in the means."""


def hands_with_body() -> dict[str, Any]:
    """Prints the table, and returns its figures."""
    dataset = Synthetic.model_validate(
        {
            "kind": "synthetic",
            "camera": {"width": 480, "height": 848, "fx": 424.0},
            "noise": 0.003,
            "defaults": {"frames": 60, "view": {"distance": 1.2}},
            "takes": TAKES,
        }
    )
    print("\nPeople with hands a metre before an upright camera, mean errors of the joints [mm],")
    print("the 95th percentile of the hands' errors, and the median time of a frame")
    head = (
        ("body alone", 12),
        ("body", 8),
        ("hands", 8),
        ("95 %", 8),
        ("alone ms", 10),
        ("ms", 6),
    )
    print(f"{'take':<16}" + "".join(f"{text:>{width}}" for text, width in head))
    rows: dict[str, dict[str, float]] = {}
    for recording in dataset.chosen():
        assert isinstance(recording, SyntheticRecording)
        alone = _tracked(recording, with_hands=False)
        whole = _tracked(recording, with_hands=True)
        rows[recording.name] = row = {
            "alone_mm": alone["body"],
            "body_mm": whole["body"],
            "hands_mm": whole["hands"],
            "worst_mm": whole["worst"],
            "alone_ms": alone["ms"],
            "ms": whole["ms"],
        }
        widths = (12, 8, 8, 8, 10, 6)
        cells = [f"{one:>{width}.1f}" for one, width in zip(row.values(), widths, strict=True)]
        print(f"{recording.name:<16}" + "".join(cells))
    keys = ("alone_mm", "body_mm", "hands_mm")
    near = [row for name, row in rows.items() if name != FAR]
    mean = {key: float(np.mean([row[key] for row in near])) for key in keys}
    ratio = mean["body_mm"] / mean["alone_mm"]
    print(f"hands {mean['hands_mm']:.1f} mm, body {ratio:.2f} of its own error")
    return {"hands_with_body_mm": mean["hands_mm"], "body_ratio": ratio, "hands": rows}


def _tracked(recording: SyntheticRecording, *, with_hands: bool) -> dict[str, float]:
    """Returns the mean errors of a recording, from the start that is found."""
    name = str(recording.subject)
    template: dict[str, Any] = {"kind": "human", "build": name, "height": HEIGHTS[name]}
    voxel, sigma, method = 0.03, 0.01, "best"
    if with_hands:
        template = {"kind": "composed", "base": template, "at": HANDS}
        voxel, sigma, method = 0.008, 0.005, "body_first"
    preprocessor = PointsPreprocessor(voxel=voxel, sigma=sigma)
    observations = [preprocessor.observation(frame) for frame in recording.frames()]
    search = StartSearch.parse(StartSearch.default(), place="benchmark", field="start")
    start = search.find(_parsed(Template, template), observations[:1])
    registrar = _parsed(Method, method).bind(start.body)
    tracker = _parsed(Tracker, "constant_velocity").bind(registrar)
    truth, markers = recording.truth(), start.body.markers
    assert truth is not None
    order = [truth.joints.index(one) for one in markers.names if one in truth.joints]
    known = np.array([one in truth.joints for one in markers.names])
    of_hands = np.array([one.startswith(("left_hand_", "right_hand_")) for one in markers.names])
    past, found, seconds = Past.start(start.pose), [], []
    for index, observation in enumerate(observations):
        begin = time.perf_counter()
        past = past.followed_by(tracker.step(observation, past))
        seconds.append(time.perf_counter() - begin)
        places = markers.place(start.body.place(past.last.pose).transforms)[known]
        found.append(1e3 * np.linalg.norm(places - truth.positions[index][order], axis=1))
    errors: Array = np.array(found)
    hands = errors[:, of_hands[known]]
    return {
        "body": float(errors[:, ~of_hands[known]].mean()),
        "hands": float(hands.mean()) if hands.size else float("nan"),
        "worst": float(np.quantile(hands, 0.95)) if hands.size else float("nan"),
        "ms": 1e3 * float(np.median(seconds)),
    }


def _parsed(slot: Any, value: Any) -> Any:
    return slot.parse(value, place="benchmark", field="part")
