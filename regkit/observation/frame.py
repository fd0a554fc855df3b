"""Frames: measurements as they come."""

from __future__ import annotations

from dataclasses import dataclass

from regkit.geometry.camera import Camera
from regkit.system.arrays import Array


@dataclass(frozen=True)
class Frame:
    """One measurement of a recording.

    Attributes:
        points: Measured points in the camera's frame (x right, y down, z forward), (N, 3) [m].
        camera: The camera, if the points are those of a depth image.
        depth: The depth image (H, W) [m], zero where nothing was measured, if there is one.
        place: Where it came from, for error messages.
    """

    points: Array
    camera: Camera | None = None
    depth: Array | None = None
    place: str | None = None
