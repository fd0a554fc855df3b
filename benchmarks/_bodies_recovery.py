"""Two hands of which one jumps: recordings for the search of a lost body beside another."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import numpy as np

from regkit_plugins.datasets.synthetic import Synthetic, SyntheticRecording

JUMPS = (0.6, 1.2)
"""Times at which the hand jumps within two frames [s]."""

STEP = 0.067
"""Duration of a jump [s]."""

PLACES: Mapping[str, tuple[Mapping[str, Any], ...]] = {
    "right": (
        {"place": [0.13, 0, 0.02], "rotation_deg": [0, 20, 0]},
        {"place": [0.15, 0.05, -0.12], "rotation_deg": [0, 0, 90]},
        {"place": [0.05, -0.05, 0.1], "rotation_deg": [0, -110, 30]},
    ),
    "left": (
        {"place": [-0.13, 0, 0], "rotation_deg": [0, 0, 20]},
        {"place": [-0.05, 0, -0.12], "rotation_deg": [60, 0, 100]},
        {"place": [-0.17, 0.04, 0.08], "rotation_deg": [0, 130, 0]},
    ),
}
"""Where each hand is before, between and after the jumps."""

GESTURES = ("point_and_pinch", "fists", "signs")


def jumping() -> list[SyntheticRecording]:
    """Returns a recording for each hand and gesture; it jumps twice, and the other hand stays."""
    takes = {
        f"{side}_{gesture}": {"bodies": {
            one: {
                "body": {"kind": "hand", "side": one},
                "motion": {"kind": "gestures", "name": gesture, "sway_phase_deg": 90},
                "course": _course(side) if one == side else [dict(PLACES[one][0])],
            }
            for one in PLACES
        }}
        for side in PLACES
        for gesture in GESTURES
    }  # fmt: skip
    whole = {
        "kind": "synthetic",
        "camera": "sr305",
        "noise": 0.002,
        "defaults": {"frames": 60, "view": {"place": [0, 0, 0.5]}},
        "takes": takes,
    }
    chosen = Synthetic.model_validate(whole).chosen()
    return [one for one in chosen if isinstance(one, SyntheticRecording)]


def _course(side: str) -> list[dict[str, Any]]:
    """Returns the places of a hand that jumps, by time."""
    course = [{"time": 0.0, **PLACES[side][0]}]
    for at, time in enumerate(JUMPS):
        course.append({"time": time, **PLACES[side][at]})
        course.append({"time": time + STEP, **PLACES[side][at + 1]})
    return course


def after_jumps(errors: np.ndarray[Any, Any], fps: float) -> np.ndarray[Any, Any]:
    """Returns the errors of the frames after the first jump."""
    return np.asarray(errors[round((JUMPS[0] + STEP) * fps) :])
