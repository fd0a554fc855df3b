"""The scenes of results: what ``view`` shows, and what is stored with a track."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from regkit.api.reference import Reference, truth_of
from regkit.metrics import joint_errors
from regkit.report.style import PALETTE
from regkit.system.arrays import Singles
from regkit.tracking.sample import thinned
from regkit.viewer.embedded import SceneView
from regkit.viewer.recording_scene import recording_scene
from regkit.viewer.run_scene import FRAMES
from regkit.viewer.scene import Scene
from regkit.viewer.track_scene import TrackScene

if TYPE_CHECKING:
    from regkit.api.tracking import Tracking

FEWEST = 20
"""Number of frames that are read again for a part of a long track, of which few are kept."""


def scene_of(tracking: Tracking, truth: Reference | None = None) -> TrackScene:
    """Returns the scene of a track, with the points that were kept while it was tracked.

    Args:
        tracking: The track.
        truth: Reference joints, if there are any.

    Raises:
        RegkitError: If they do not match the frames or the markers, or a frame can no longer be
            read.
    """
    track, body = tracking.track, tracking.body
    known = None if truth is None else truth_of(truth, body, tracking.numbers)
    errors = None if known is None else joint_errors(track, body, known, {}).of_frames()
    marked = {}
    badness = np.where(track.seen, track.surface_distances if errors is None else errors, np.nan)
    if np.isfinite(badness).any() and len(tracking) > 1:
        marked = {int(np.nanargmax(badness)): "worst"}
    return TrackScene.of(
        track,
        tracking.registrar,
        _points(tracking, [*marked]),
        fps=tracking.fps,
        camera=tracking.recorder.sample.camera,
        cameras=tracking.recorder.sample.cameras.values(),
        truth=known,
        errors=errors,
        marked=marked,
    )


def view_of(tracking: Tracking, truth: Reference | None, height: int) -> SceneView:
    """Returns the view of a track; the arguments are those of ``Tracking.view``."""
    method, track = tracking.method, scene_of(tracking, truth)
    one = recording_scene(tracking.name, {method: track}, {method: PALETTE[0]}, FRAMES)
    shown = len(one.frames)
    note = f"{shown} of {one.length} frames are shown." if shown < one.length else ""
    return SceneView(Scene(tracking.name, (one,), note), height)


def _points(tracking: Tracking, wanted: list[int]) -> dict[int, Singles]:
    """Returns the points (N, 3) [m] of frames of a track, by their place in it.

    Args:
        tracking: The track, which may be a part of a recording.
        wanted: Places of frames that must be among them.
    """
    kept = tracking.recorder.sample.points
    points: dict[int, Singles] = {
        at: kept[number] for at, number in enumerate(tracking.indices) if number in kept
    }
    seen = np.flatnonzero(tracking.track.seen)
    if len(points) < min(FEWEST, len(seen)):
        spread = np.linspace(0, len(seen) - 1, min(FEWEST, len(seen))).round().astype(int)
        wanted = [*wanted, *map(int, seen[spread])]
    for at in wanted:
        # The frames of a camera cannot be read again.
        if at not in points and tracking.recorder.has(tracking.indices[at]):
            points[at] = thinned(tracking.snapshot(at).points)
    return points
