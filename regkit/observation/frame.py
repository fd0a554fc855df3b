"""Frames: raw measurements."""

from __future__ import annotations

from dataclasses import dataclass

from regkit.geometry.camera import Camera
from regkit.system.arrays import Array
from regkit.system.brief import Brief


@dataclass(frozen=True)
class Frame(Brief):
    """One measurement of a recording.

    Attributes:
        points: Points in the camera frame (x right, y down, z forward), (N, 3) [m].
        camera: Intrinsics, if the points come from a depth image.
        depth: Depth image, (H, W) [m], zero at invalid pixels; None if there is none.
        place: Source of the frame, for error messages.
    """

    points: Array
    camera: Camera | None = None
    depth: Array | None = None
    place: str | None = None
