"""A RealSense camera without hardware, by the software device of RealSense's own library."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path
from typing import Any

import numpy as np
import pyrealsense2 as rs
from bags import CAMERA, walk_images


class SoftCamera:
    """A camera of RealSense's library without hardware, which shows what it is given."""

    def __init__(
        self,
        serial: str = "0123",
        unit: float = 0.001,
        model: Any = None,
        coefficients: Sequence[float] = (0.0,) * 5,
    ) -> None:
        self.device = rs.software_device()
        self.device.register_info(rs.camera_info.serial_number, serial)
        self.device.register_info(rs.camera_info.name, "Soft Camera")
        self.sensor = self.device.add_sensor("Stereo Module")
        intrinsics = rs.intrinsics()
        intrinsics.width, intrinsics.height = CAMERA.width, CAMERA.height
        intrinsics.fx, intrinsics.fy = CAMERA.fx, CAMERA.fy
        intrinsics.ppx, intrinsics.ppy = CAMERA.cx, CAMERA.cy
        intrinsics.model = rs.distortion.brown_conrady if model is None else model
        intrinsics.coeffs = list(coefficients)
        self.profiles = [self._profile(intrinsics, fps) for fps in (30, 15)]
        self.sensor.add_read_only_option(rs.option.depth_units, unit)
        self.unit = unit

    def _profile(self, intrinsics: Any, fps: int) -> Any:
        stream = rs.video_stream()
        stream.type, stream.fmt = rs.stream.depth, rs.format.z16
        stream.index, stream.uid, stream.bpp, stream.fps = 0, fps, 2, fps
        stream.width, stream.height = intrinsics.width, intrinsics.height
        stream.intrinsics = intrinsics
        return self.sensor.add_video_stream(stream, fps == 30)

    def show(self, image: np.ndarray, number: int) -> None:
        """Measures an image of ``u2``."""
        frame = rs.software_video_frame()
        frame.bpp, frame.stride = 2, 2 * image.shape[1]
        frame.timestamp, frame.domain = number * 1000.0 / 30.0, rs.timestamp_domain.hardware_clock
        frame.frame_number, frame.depth_units = number, self.unit
        frame.profile = self.profiles[0].as_video_stream_profile()
        frame.pixels = np.ascontiguousarray(image)
        self.sensor.on_video_frame(frame)


def record_walk(path: Path, count: int) -> Path:
    """Records the first frames of the shipped walk by RealSense's library, and returns the file."""
    camera = SoftCamera()
    recorder = rs.recorder(str(path), camera.device)
    (sensor,) = recorder.query_sensors()
    queue = rs.frame_queue(count, keep_frames=True)
    sensor.open(camera.profiles[0])
    sensor.start(queue)
    for number, image in enumerate(walk_images(count)):
        camera.show(image, number)
        queue.wait_for_frame()
    sensor.stop()
    sensor.close()
    return path
