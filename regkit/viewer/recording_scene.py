"""The scene of a recording from the tracks of its methods."""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np

from regkit.viewer.points import FramePoints, evenly
from regkit.viewer.scene import MethodScene, RecordingScene
from regkit.viewer.track_scene import TrackScene


def recording_scene(
    name: str, tracks: Mapping[str, TrackScene], colours: Mapping[str, str], most: int
) -> RecordingScene:
    """Returns the scene of a recording, with at most ``most`` of its frames.

    The marked frames of every method are among them, and the others are spread evenly.

    Args:
        name: Name of the recording.
        tracks: The tracks of at least one method, by its name.
        colours: Colours of the methods, #rrggbb.
        most: Maximum number of frames.
    """
    length = min(len(track) for track in tracks.values())
    points = {
        frame: cloud
        for track in reversed(list(tracks.values()))
        for frame, cloud in track.points.by_frame().items()
        if frame < length
    }
    why: dict[int, list[str]] = {}
    for method, track in tracks.items():
        for frame, reason in track.marked.items():
            if frame in points:
                why.setdefault(frame, []).append(f"{reason} of {method}")
    frames = evenly(sorted(points), most, sorted(why))
    first = next(iter(tracks.values()))
    reference = np.full((len(frames), len(first.joints), 3), np.nan)
    for track in tracks.values():
        # Methods may have kept different frames; the reference is the same for all.
        at = {int(frame): index for index, frame in enumerate(track.points.frames)}
        for row, frame in enumerate(frames):
            if frame in at and track.joints == first.joints:
                reference[row] = track.reference[at[frame]]
    return RecordingScene(
        name=name,
        fps=first.fps,
        length=length,
        frames=np.array(frames, dtype=np.intp),
        points=FramePoints.of({frame: points[frame] for frame in frames}),
        methods=tuple(MethodScene(one, colours[one], track) for one, track in tracks.items()),
        marked=tuple((frame, ", ".join(why[frame])) for frame in frames if frame in why),
        joints=first.joints,
        reference=reference,
        camera=first.camera,
        cameras=first.cameras,
    )
