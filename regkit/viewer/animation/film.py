"""A track as an animated picture, GIF or WebP."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from io import BytesIO
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np

from regkit.system.arrays import Array
from regkit.system.errors import ConfigError, DataError
from regkit.system.files import replacing
from regkit.system.progress import steps
from regkit.viewer.animation.drawing import Drawing
from regkit.viewer.animation.model import extent_of
from regkit.viewer.animation.pose import ShownPose, drawn_bones
from regkit.viewer.animation.view import Sheet, views
from regkit.viewer.track_scene import TrackScene

if TYPE_CHECKING:
    from PIL.Image import Image

FORMATS = (".gif", ".webp")
"""Suffixes of animated pictures."""

SHEET = Sheet(720, 430)
"""Size of a picture [px]."""

BYTES = 5_000_000
"""Maximum size of a file."""

SHORTEST = 0.02
"""Shortest time [s] of a picture that browsers show as it is."""


@dataclass(frozen=True)
class Film:
    """What was written.

    Attributes:
        frames: Number of pictures.
        length: Number of frames of the track.
        seconds: How long it lasts [s].
        size: Size of the file [bytes].
    """

    frames: int
    length: int
    seconds: float
    size: int


def write_film(track: TrackScene, file: Path, fps: float | None = None) -> Film:
    """Writes the frames of a track that have points as an animated picture.

    It lasts as long as the recording. Frames are left out where they would be too short to be
    shown, or the file larger than 5 MB.

    Args:
        track: The track.
        file: The file, .gif or .webp; an existing one is replaced.
        fps: Frames per second of the track; by default those of the recording.

    Raises:
        ConfigError: If the suffix is another.
        DataError: If no frame has points, or the file cannot be written.
    """
    if file.suffix.lower() not in FORMATS:
        raise ConfigError(
            f"'{file.suffix}' is no animated picture ({', '.join(FORMATS)})", place=str(file)
        )
    rate = track.fps if fps is None else fps
    times = _spaced([frame / rate for frame in track.points.frames], SHORTEST)
    if not times:
        raise DataError("no frame of the track has points to show", place=str(file))
    poses = [ShownPose.of(track, int(track.points.frames[at]), track.points.at(at)) for at in times]
    drawing = drawing_of(track, poses, SHEET)
    pictures = [drawing.picture(pose) for pose in steps(poses, "drawing", len(poses))]
    begins = list(times.values())
    while True:
        last = begins[-1] - begins[-2] if len(begins) > 1 else 1.0
        content = encoded(pictures, durations([*begins, begins[-1] + last]), file.suffix)
        if len(content) <= BYTES or len(pictures) == 1:
            break
        pictures, begins = pictures[::2], begins[::2]
    with replacing(file) as temporary:
        temporary.write_bytes(content)
    return Film(len(pictures), len(track), begins[-1] + last - begins[0], len(content))


def drawing_of(
    track: TrackScene, poses: Sequence[ShownPose], sheet: Sheet, ground: float | None = None
) -> Drawing:
    """Returns what the pictures of a track share: views in which all poses are in sight.

    Args:
        track: The track.
        poses: Its frames.
        sheet: Size of a picture.
        ground: How far the ground is below the camera [m]; None without a ground.
    """
    shape = track.shapes[0]
    extent = np.concatenate([_extent(track, pose) for pose in poses])
    return Drawing(sheet, views(sheet, extent), shape, drawn_bones(track), ground)


def encoded(pictures: Sequence[Image], milliseconds: Sequence[int], suffix: str) -> bytes:
    """Returns pictures as an animated GIF or WebP that repeats.

    Args:
        pictures: The pictures.
        milliseconds: How long each is shown.
        suffix: ``.gif`` or ``.webp``.
    """
    content = BytesIO()
    first, *others = pictures
    options = {"quality": 84, "method": 4} if suffix.lower() == ".webp" else {"optimize": False}
    first.save(
        content,
        format=suffix[1:].upper(),
        save_all=True,
        append_images=others,
        duration=list(milliseconds),
        loop=0,
        **options,
    )
    return content.getvalue()


def durations(begins: Sequence[float]) -> list[int]:
    """Returns how long pictures are shown [ms], in the whole hundredths of a second of a GIF.

    Args:
        begins: When each begins [s], and the end. Rounded are these, so that no error adds up.
    """
    hundredths = np.rint(100.0 * np.array(begins)).astype(int)
    return [int(one) for one in 10 * np.maximum(np.diff(hundredths), 1)]


def _spaced(begins: Sequence[float], shortest: float) -> dict[int, float]:
    """Returns the places and times of frames that are at least so far apart [s]."""
    kept: dict[int, float] = {}
    last = -np.inf
    for at, begin in enumerate(begins):
        if begin - last >= shortest * (1.0 - 1e-6):
            kept[at] = last = begin
    return kept


def _extent(track: TrackScene, pose: ShownPose) -> Array:
    """Returns what must be in sight of a frame, (N, 3) [m]: all but stray points."""
    points = pose.points
    if len(points):
        low, high = np.percentile(points, [1.0, 99.0], axis=0)
        points = points[((points >= low) & (points <= high)).all(axis=1)]
    return np.concatenate([points, pose.ends, extent_of(track.shapes[:1], pose.transforms)])
