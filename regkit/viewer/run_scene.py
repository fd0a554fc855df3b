"""The scene of a run: some frames of each recording, with every method that tracked it."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import replace

from regkit.viewer.recording_scene import recording_scene
from regkit.viewer.scene import MOST_VALUES, Scene
from regkit.viewer.track_scene import TrackScene

FRAMES, ALL_FRAMES, FEWEST = 60, 240, 4
"""Maximum number of frames of one recording and of all, and what each recording has at least."""

FEWEST_VALUES = 200
"""Number of values that a curve has at least, if there are so many frames."""

Stored = Mapping[str, Callable[[], TrackScene | None]]
"""What reads the track of each method by its name; it returns None if none was stored."""


def run_scene(
    title: str,
    recordings: Mapping[str, Stored],
    colours: Mapping[str, str],
    frames: int = ALL_FRAMES,
) -> Scene | None:
    """Returns the scene of recordings; None if nothing was stored of any.

    Args:
        title: The title.
        recordings: What reads the tracks of each recording, by its name.
        colours: Colours of the methods, #rrggbb.
        frames: Maximum number of frames of all recordings; each has at most ``FRAMES``.

    Raises:
        DataError: If a file is damaged.
    """
    shown = list(recordings)[: frames // FEWEST]
    most = min(FRAMES, frames // max(len(shown), 1))
    values = max(FEWEST_VALUES, MOST_VALUES // max(len(shown), 1))
    scenes, lacking = [], []
    for name in shown:
        read = {method: track() for method, track in recordings[name].items()}
        lacking += [f"{method} on {name}" for method, track in read.items() if track is None]
        tracks = {method: track for method, track in read.items() if track is not None}
        if tracks:
            one = recording_scene(name, tracks, colours, most)
            scenes.append(replace(one, values=values))
    if not scenes:
        return None
    notes = []
    parts, every = sum(len(one.frames) for one in scenes), sum(one.length for one in scenes)
    if parts < every:
        notes.append(f"{parts} of {every} frames are shown.")
    if len(recordings) > len(shown):
        notes.append(f"{len(shown)} of {len(recordings)} recordings are shown.")
    if lacking:
        notes.append(f"Stored without a scene, and not shown: {', '.join(lacking)}.")
    return Scene(title, tuple(scenes), " ".join(notes))
