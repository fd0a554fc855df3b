"""One frame of a track, as a picture shows it."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Self

import numpy as np

from regkit.system.arrays import Array, Indices
from regkit.viewer.shapes import moved
from regkit.viewer.track_scene import TrackScene

MIDDLE, LEFT, RIGHT = (240, 190, 104), (86, 178, 170), (236, 128, 110)
"""Colours of a body's middle and of its sides."""

UNSURE = (188, 190, 196)
"""Colour of a segment without data."""


@dataclass(frozen=True)
class ShownPose:
    """A frame of a track, in the camera's frame.

    Attributes:
        frame: Its number.
        points: The data, (N, 3) [m].
        transforms: Quaternion and origin [m] of each segment, (S, 7).
        ends: Origins of the segments, then the markers, (S + M, 3) [m].
        colours: Colour of each segment, (S, 3) from 0 to 255.
        verdict: Whether the body was found.
    """

    frame: int
    points: Array
    transforms: Array
    ends: Array
    colours: Array
    verdict: str

    @classmethod
    def of(cls, track: TrackScene, frame: int, points: Array) -> Self:
        """Returns a frame of a track, with the given points (N, 3) [m]."""
        transforms = track.transforms[frame]
        carriers = transforms[track.markers.segments]
        markers = moved(carriers, track.markers.points)
        return cls(
            frame=frame,
            points=points,
            transforms=transforms,
            ends=np.concatenate([transforms[:, 4:], markers]),
            colours=_colours(track.segments, track.supports[frame]),
            verdict=str(track.verdicts[frame]),
        )


def _colours(segments: Sequence[str], supports: Array) -> Array:
    """Returns the colours of segments (S, 3), greyer the less data they have."""
    sided = [
        LEFT if name.startswith("left_") else RIGHT if name.startswith("right_") else MIDDLE
        for name in segments
    ]
    sure = np.where(np.isfinite(supports), supports, 1.0)[:, None]
    return np.asarray(sure * np.array(sided, dtype=float) + (1.0 - sure) * np.array(UNSURE))


def drawn_bones(track: TrackScene) -> Indices:
    """Returns the bones that are longer than nothing in the first frame, (B, 2)."""
    first = ShownPose.of(track, 0, np.zeros((0, 3)))
    lengths = np.linalg.norm(np.diff(first.ends[track.bones], axis=1)[:, 0], axis=1)
    bones: Indices = track.bones[lengths > 1e-3 * np.ptp(first.ends, axis=0).max()]
    return bones
