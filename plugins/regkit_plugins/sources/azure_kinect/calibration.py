"""The depth camera in ``calibration.json``, as a camera of Azure Kinect stores it.

https://github.com/microsoft/Azure-Kinect-Sensor-SDK, ``src/calibration`` and
``src/transformation``.
"""

from __future__ import annotations

import json
from typing import Any

from regkit.geometry import Camera, Lens
from regkit.system.errors import DataError
from regkit_plugins.sources.formats.lenses import brown_conrady

LOCATION = "CALIBRATION_CameraLocationD0"
"""Name of the depth camera."""

MODEL = "CALIBRATION_LensDistortionModelBrownConrady"
"""The model of all cameras that were sold; its parameters are those of OpenCV's rational model."""

MODES = {
    (320, 288): (512, (96, 90)),
    (640, 576): (1024, (192, 180)),
    (512, 512): (512, (0, 0)),
    (1024, 1024): (1024, (0, 0)),
}
"""Width of the sensor, binned or not, and the image's corner on it, by the image's size [px]."""


def lens_of(content: bytes, width: int, height: int) -> Lens:
    """Returns the depth camera of images of a size.

    Args:
        content: The content of ``calibration.json``.
        width: Width of the depth images [px].
        height: Height of the depth images [px].

    Raises:
        DataError: If the size is none of a depth mode, or the calibration cannot be used.
    """
    if (width, height) not in MODES:
        sizes = ", ".join("{}x{}".format(*size) for size in MODES)
        raise DataError(f"no depth mode has {width}x{height} pixels; there are {sizes}")
    sensor, corner = MODES[width, height]
    intrinsics = _depth_camera(content)["Intrinsics"]
    model = str(intrinsics["ModelType"])
    if model != MODEL:
        raise DataError(
            f"the depth camera has the distortion model '{model}', which no camera that was sold "
            "has; it is not supported"
        )
    # Lengths are divided by the sensor's size, and zero is the corner of the first pixel.
    cx, cy, fx, fy, k1, k2, k3, k4, k5, k6, codx, cody, p2, p1 = map(
        float, intrinsics["ModelParameters"][:14]
    )
    if codx or cody:
        raise DataError("the depth camera has a centre of distortion, which is not supported")
    camera = Camera(
        width,
        height,
        fx * sensor,
        fy * sensor,
        cx * sensor - corner[0] - 0.5,
        cy * sensor - corner[1] - 0.5,
    )
    return Lens(camera, brown_conrady([k1, k2, p1, p2, k3, k4, k5, k6]))


def _depth_camera(content: bytes) -> dict[str, Any]:
    """Returns the entry of the depth camera."""
    cameras = json.loads(content.rstrip(b"\0"))["CalibrationInformation"]["Cameras"]
    for camera in cameras:
        if camera["Location"] == LOCATION:
            return dict(camera)
    raise DataError("the calibration has no depth camera")
