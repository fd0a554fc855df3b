"""A scene: what the page shows of recordings, as one JSON document."""

from __future__ import annotations

import json
from collections.abc import Sequence
from dataclasses import dataclass, field
from itertools import groupby
from typing import Any

import numpy as np

from regkit.geometry.camera import Camera
from regkit.observation import PlacedCamera
from regkit.system.arrays import Array, Indices
from regkit.viewer.packed import packed
from regkit.viewer.points import FramePoints
from regkit.viewer.track_scene import TrackScene

FORMAT = 1
"""Version of the document."""

UP = (0.0, -1.0, 0.0)
"""The direction that is up in a camera's frame, whose y points down."""

MOST_VALUES = 3000
"""Maximum number of values of a curve; a page is not wider."""


@dataclass(frozen=True)
class Cloud:
    """A cloud that does not move.

    Attributes:
        name: What it is.
        colour: Its colour, #rrggbb.
        positions: Points, (N, 3) [m].
    """

    name: str
    colour: str
    positions: Array

    def json(self) -> dict[str, Any]:
        """Returns the cloud as JSON."""
        return vars(self) | {"positions": packed(self.positions, "f4")}


@dataclass(frozen=True)
class MethodScene:
    """A method's track, of which the scene has some frames.

    Attributes:
        name: Name of the method.
        colour: Its colour, #rrggbb.
        track: Its track.
    """

    name: str
    colour: str
    track: TrackScene

    def json(self, frames: Indices, values: int) -> dict[str, Any]:
        """Returns the method as JSON.

        Args:
            frames: Numbers of the frames in the scene, (F,).
            values: Maximum number of values of a curve.
        """
        track = self.track
        supports = track.supports[frames]
        # A segment without a surface of its own is as sure as those around it.
        known = np.isfinite(supports)
        confidence = packed(np.where(known, supports, 1.0), "f4") if known.any() else None
        every = max(1, -(-len(track) // values))
        numbers = packed(np.arange(0, len(track), every), "u4")
        return {
            "name": self.name,
            "colour": self.colour,
            "segments": list(track.segments),
            "bones": packed(track.bones, "u2"),
            "markers": {
                "names": list(track.markers.names),
                "positions": packed(track.marker_positions(frames), "f4"),
            },
            "transforms": packed(track.transforms[frames], "f4"),
            "shapes": [shape.json() for shape in track.shapes],
            "verdicts": [[name, len(list(run))] for name, run in groupby(map(str, track.verdicts))],
            "confidence": confidence,
            "ellipsoids": None
            if track.ellipsoids is None
            else packed(track.ellipsoids[frames], "f4"),
            "curves": [
                {
                    "name": curve.name,
                    "unit": curve.unit,
                    "frames": numbers,
                    "values": packed(curve.values[::every], "f4"),
                }
                for curve in track.curves
            ],
        }


@dataclass(frozen=True)
class RecordingScene:
    """A recording with the methods that tracked it.

    Attributes:
        name: Name of the recording.
        fps: Frames per second.
        length: Number of frames of the whole recording.
        frames: Numbers of the F frames in the scene, (F,), ascending.
        points: Their points, or the address that serves those of a frame: ``points/0/{index}``.
        methods: The methods.
        marked: Marked frames by number, and why.
        clouds: Clouds that do not move.
        joints: Names of reference joints.
        reference: Their positions, (F, J, 3) [m]; NaN where unknown.
        camera: The camera, if it is known.
        cameras: Several cameras in the world; none if there is one at the origin.
        up: The direction that is up.
        values: Maximum number of values of a curve.
    """

    name: str
    fps: float
    length: int
    frames: Indices
    points: FramePoints | str
    methods: tuple[MethodScene, ...] = ()
    marked: tuple[tuple[int, str], ...] = ()
    clouds: tuple[Cloud, ...] = ()
    joints: tuple[str, ...] = ()
    reference: Array = field(default_factory=lambda: np.zeros((0, 0, 3)))
    camera: Camera | None = None
    cameras: tuple[PlacedCamera, ...] = ()
    up: Sequence[float] = UP
    values: int = MOST_VALUES

    def json(self) -> dict[str, Any]:
        """Returns the recording as JSON."""
        joints = None
        if self.joints:
            joints = {"names": list(self.joints), "positions": packed(self.reference, "f4")}
        points = {"href": self.points} if isinstance(self.points, str) else self.points.json()
        return {
            "name": self.name,
            "fps": self.fps,
            "length": self.length,
            "frames": self.frames.tolist(),
            "marked": [{"frame": frame, "why": why} for frame, why in self.marked],
            "points": points,
            "clouds": [cloud.json() for cloud in self.clouds],
            "joints": joints,
            "up": list(self.up),
            "camera": None if self.camera is None else vars(self.camera),
            "cameras": cameras_json(self.cameras),
            "methods": [method.json(self.frames, self.values) for method in self.methods],
        }


def cameras_json(cameras: Sequence[PlacedCamera]) -> list[dict[str, Any]]:
    """Returns cameras as JSON: names, places, and where their pictures' corners are at a metre."""
    return [
        {
            "name": one.name,
            "place": one.T_world_camera[:3, 3].tolist(),
            "corners": one.corners().tolist(),
        }
        for one in cameras
    ]


@dataclass(frozen=True)
class Scene:
    """What the page shows.

    Attributes:
        title: The title.
        recordings: The recordings.
        note: A sentence about what is left out; empty if nothing is.
        live: Whether frames follow by server-sent events.
    """

    title: str
    recordings: tuple[RecordingScene, ...]
    note: str = ""
    live: bool = False

    def json(self) -> bytes:
        """Returns the document as UTF-8."""
        document = {
            "format": FORMAT,
            "title": self.title,
            "note": self.note,
            "live": self.live,
            "recordings": [recording.json() for recording in self.recordings],
        }
        return json.dumps(document, allow_nan=False, separators=(",", ":")).encode()
