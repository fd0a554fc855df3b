"""The animated picture of a track at the top of the README, drawn from a real run.

Ellipsoids are the Gaussians of the human template at two standard deviations; dots are the points
of the depth images.
"""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path

import numpy as np
from PIL import Image

import regkit
from _animation.drawing import drawn
from _animation.snapshot import Snapshot
from _animation.view import views

MILLISECONDS = 66
"""How long each frame is shown: the walk of two seconds takes four."""

_SOLE = 0.01
"""How far the sole is below the lowest marker, at the toes [m]."""


def pictures(snapshots: list[Snapshot]) -> Iterator[Image.Image]:
    """The points alone, the model that appears in them, the walk, and the model that goes."""
    both = views(np.mean([snapshot.markers["pelvis"] for snapshot in snapshots], axis=0))
    for presence in (0.0, 0.0, 0.0, 0.0, 0.0, 0.25, 0.5, 0.75):
        yield drawn(snapshots[0], both, presence)
    for snapshot in snapshots:
        yield drawn(snapshot, both, 1.0)
    for presence in (1.0, 1.0, 1.0, 0.66, 0.33):
        yield drawn(snapshots[-1], both, presence)


def write_animation(recording_folder: Path, file: Path) -> None:
    """Track the walk, and write its animated picture (WebP)."""
    walk = regkit.load_recording(recording_folder)
    tracked = regkit.track(walk, regkit.load_template("human", height=1.63))
    ground = _SOLE + float(tracked.markers[..., 1].max())
    snapshots = [
        Snapshot.of(tracked, index, frame.points, ground)
        for index, frame in enumerate(walk.frames())
    ]
    first, *others = pictures(snapshots)
    first.save(
        file,
        save_all=True,
        append_images=others,
        duration=MILLISECONDS,
        loop=0,
        quality=84,
        method=6,
    )
