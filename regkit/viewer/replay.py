"""A replay: the scene of a run as one file that opens without a network, of limited size."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass, replace

from regkit.system.errors import DataError
from regkit.viewer.page import page
from regkit.viewer.points import FramePoints
from regkit.viewer.recording_scene import recording_scene
from regkit.viewer.scene import RecordingScene, Scene
from regkit.viewer.track_scene import TrackScene

FRAMES, ALL_FRAMES, FEWEST = 60, 240, 4
"""Maximum number of frames of one recording and of all, and what each recording has at least."""

BYTES, ALL_BYTES = 5_000_000, 20_000_000
"""Maximum size of a replay of one recording and of several."""

MOST_RECORDINGS = ALL_FRAMES // FEWEST
"""Maximum number of recordings in a replay."""

SPARE = 0.95
"""Part of the room that points may take, since how well they shrink is only known afterwards."""


@dataclass(frozen=True)
class Replayed:
    """A recording of a run.

    Attributes:
        tracks: Reads the track of each method that finished it; None for one that was stored
            without a scene.
    """

    tracks: Mapping[str, Callable[[], TrackScene | None]]


def replay(title: str, recordings: Mapping[str, Replayed], colours: Mapping[str, str]) -> str:
    """Returns the page with the scene of recordings.

    Args:
        title: The title.
        recordings: Recordings by name; tracks are read one recording at a time.
        colours: Colours of the methods, #rrggbb.

    Raises:
        DataError: If no track has a scene, or a file is damaged.
    """
    shown = list(recordings)[:MOST_RECORDINGS]
    each = max(FEWEST, min(FRAMES, ALL_FRAMES // max(len(shown), 1)))
    scenes, lacking = [], []
    for name in shown:
        read = {method: track() for method, track in recordings[name].tracks.items()}
        lacking += [f"{method} on {name}" for method, track in read.items() if track is None]
        tracks = {method: track for method, track in read.items() if track is not None}
        if tracks:
            scenes.append(recording_scene(name, tracks, colours, each))
    if not scenes:
        raise DataError("no track has a scene; they are older than replays, run them again")
    notes = _thinned(scenes)
    if len(recordings) > len(shown):
        notes.append(f"{len(shown)} of {len(recordings)} recordings are shown.")
    if lacking:
        notes.append(f"Without a stored scene, and not shown: {', '.join(lacking)}.")
    most = BYTES if len(scenes) == 1 else ALL_BYTES
    return _capped(Scene(title, tuple(scenes), " ".join(notes)), most)


def _thinned(scenes: list[RecordingScene]) -> list[str]:
    """Returns what is told of the frames that are left out."""
    shown = sum(len(scene.frames) for scene in scenes)
    every = sum(scene.length for scene in scenes)
    return [] if shown == every else [f"{shown} of {every} frames are shown."]


def _capped(scene: Scene, most: int) -> str:
    """Returns the page of a scene, whose points are thinned until it has at most ``most`` bytes.

    Raises:
        DataError: If it is larger even without points.
    """
    whole = page(scene.title, scene.json())
    if len(whole.encode()) <= most:
        return whole
    bare = len(page(scene.title, _with_points(scene, 0.0).json()).encode())
    if bare > most:
        raise DataError(
            f"the replay has {bare / 1e6:.1f} MB without any points, more than {most / 1e6:g} MB: "
            "its models are too large"
        )
    share = 1.0
    while len(whole.encode()) > most:
        share *= SPARE * (most - bare) / (len(whole.encode()) - bare)
        less = _with_points(scene, share)
        told = f"{scene.note} {100.0 * share:.0f} % of their points are shown.".strip()
        whole = page(scene.title, replace(less, note=told).json())
    return whole


def _with_points(scene: Scene, share: float) -> Scene:
    """Returns the scene with a share of the points of each frame."""
    return replace(
        scene,
        recordings=tuple(
            replace(one, points=one.points.thinned(share))
            if isinstance(one.points, FramePoints)
            else one
            for one in scene.recordings
        ),
    )
