"""A tracked frame as browsers get it while a track is computed."""

from __future__ import annotations

import json
from collections.abc import Mapping
from dataclasses import dataclass
from functools import cached_property
from typing import Any

import numpy as np

from regkit.observation import PlacedCamera
from regkit.system.arrays import Array
from regkit.viewer.model_shapes import transforms_of
from regkit.viewer.packed import packed
from regkit.viewer.points import packed_frame
from regkit.viewer.scene import cameras_json

MOST_POINTS = 1500
"""Maximum number of points of a frame."""


@dataclass(frozen=True)
class LiveFrame:
    """A tracked frame for browsers; its text is made when the first browser asks for it.

    Attributes:
        number: Number of the frame.
        time: Its time [s].
        points: Its data, (N, 3) [m].
        method: Name of the method.
        transforms: T_camera_segment, (S, 4, 4) [m].
        markers: The markers, (M, 3) [m].
        supports: How well data support each segment, (S,), from 0 to 1; None if unknown.
        verdict: Whether the body was found.
        curves: Numbers of the frame by the names of their curves.
        status: A few words on the state, such as the speed.
        cameras: Several cameras in the world; none if there is one at the origin.
    """

    number: int
    time: float
    points: Array
    method: str
    transforms: Array
    markers: Array
    supports: Array | None
    verdict: str
    curves: Mapping[str, float]
    status: str
    cameras: tuple[PlacedCamera, ...] = ()

    @cached_property
    def event(self) -> bytes:
        """The frame as a server-sent event."""
        tracked: dict[str, Any] = {
            "name": self.method,
            "transforms": packed(transforms_of(self.transforms), "f4"),
            "markers": packed(self.markers, "f4"),
            "verdict": self.verdict,
            "curves": {name: one for name, one in self.curves.items() if np.isfinite(one)},
        }
        if self.supports is not None:
            known = np.where(np.isfinite(self.supports), self.supports, 1.0)
            tracked["confidence"] = packed(known, "f4")
        content: dict[str, Any] = {
            "frame": self.number,
            "time": self.time,
            "points": packed_frame(self.points, MOST_POINTS),
            "status": self.status,
            "methods": [tracked],
        }
        if self.cameras:
            content["cameras"] = cameras_json(self.cameras)
        return b"data: " + json.dumps(content, separators=(",", ":")).encode() + b"\n\n"
