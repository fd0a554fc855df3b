"""Tracking in rooms against tracking the same walk alone, and the pixels that are kept.

    python benchmarks/rooms.py

The body's size is given, and the pose in the first frame is that found for the walk alone, so that
the figures show the segmentation and not the search for a start.
"""

from __future__ import annotations

import json
import warnings
from collections.abc import Mapping
from typing import Any

import numpy as np
from threadpoolctl import threadpool_limits

import regkit
from regkit.interfaces import Expected
from regkit_plugins.datasets.synthetic import Synthetic, SyntheticRecording
from regkit_plugins.segmenters.room import Room
from regkit_synthesis.rooms import ROOMS

FRAMES = 40
VIEWS: Mapping[str, tuple[float, Mapping[str, Any]]] = {
    "average, from the front": (1.633, {}),
    "tall, 20 degrees aside": (1.81, {"body": "tall", "view": {"heading_deg": 20}}),
    "average, from above": (1.633, {"view": {"elevation_deg": 25, "heading_deg": -25}}),
}
"""The height of the body [m] and the fields of its take."""


def kept(recording: SyntheticRecording, tracking: regkit.Tracking) -> tuple[float, float]:
    """Returns the shares of the body's and of the other pixels that are kept in tracking."""
    template = regkit.load_template("human", height=tracking.size)
    bound = Room().bind(recording, template)
    counts = np.zeros(4)
    poses = [tracking.poses[0], *tracking.poses]
    shots = zip(recording.frames(), recording.labels(), strict=True)
    for index, (frame, labels) in enumerate(shots):
        before = poses[index - 1] if index > 1 else None
        left = bound.segmented(frame, Expected(tracking.body, poses[index], before))
        assert frame.depth is not None
        assert left.depth is not None
        seen, still, body = frame.depth > 0.0, left.depth > 0.0, labels == 1
        counts += [(still & body).sum(), (seen & body).sum(),
                   (still & ~body).sum(), (seen & ~body).sum()]  # fmt: skip
    return float(counts[0] / counts[1]), float(counts[2] / max(counts[3], 1.0))


def main() -> None:
    """Prints a table, and as the last line the same figures as JSON."""
    warnings.simplefilter("ignore", regkit.RegkitWarning)
    figures: dict[str, dict[str, list[float]]] = {}
    print(
        f"{'view':<26}{'room':<12}{'error [cm]':>11}{'ratio':>8}{'body kept':>11}{'room kept':>11}"
    )
    for view, (height, take) in VIEWS.items():
        takes = {name: {"room": name} for name in ROOMS}
        defaults = {"motion": "walk", "frames": FRAMES, **take}
        recordings = Synthetic.model_validate({"defaults": defaults, "takes": takes}).chosen()
        template = regkit.load_template("human", height=height)
        start, alone = None, float("nan")
        for recording in recordings:
            assert isinstance(recording, SyntheticRecording)
            truth = recording.truth()
            assert truth is not None
            if start is None:
                start = regkit.track(recording, template).poses[0]
            tracking = regkit.track(recording, template, start=start)
            error = 100.0 * tracking.error(truth)
            alone = error if recording.name == "none" else alone
            body, room = kept(recording, tracking)
            print(f"{view:<26}{recording.name:<12}{error:>11.1f}{error / alone:>8.2f}"
                  f"{100 * body:>10.1f}%{100 * room:>10.2f}%")  # fmt: skip
            room_figures = figures.setdefault(recording.name, {})
            for name, value in (("error_cm", error), ("ratio", error / alone),
                                ("body_kept", body), ("room_kept", room)):  # fmt: skip
                room_figures.setdefault(name, []).append(round(value, 4))
    print(json.dumps({"threads": 1, "frames": FRAMES, "rooms": figures}))


if __name__ == "__main__":
    with threadpool_limits(1):
        main()
