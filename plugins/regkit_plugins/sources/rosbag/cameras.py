"""Cameras in messages ``sensor_msgs/CameraInfo``.

https://docs.ros.org/en/api/sensor_msgs/html/msg/CameraInfo.html, and REP 104.
"""

from __future__ import annotations

from typing import Any

import numpy as np

from regkit.geometry import Camera, Lens
from regkit.geometry.distortion import Distortion, KannalaBrandt
from regkit.geometry.intrinsics import intrinsics_of
from regkit.system.errors import DataError
from regkit_plugins.sources.formats.lenses import brown_conrady


def lens_of(info: Any, *, rectified: bool) -> Lens:
    """Returns the camera of a message.

    Args:
        info: The message; fields are in upper case in ROS 1, and in lower case in ROS 2.
        rectified: Whether the images are rectified: P is their matrix, and they have no distortion.

    Raises:
        DataError: If it is not calibrated, is a part of the image, or has an unknown distortion.
    """
    region = info.roi
    if region.x_offset or region.y_offset or max(info.binning_x, info.binning_y) > 1:
        raise DataError(
            "the camera's images are a region (roi) or binned, which is not supported; record the "
            "whole image"
        )
    matrix = np.array(_field(info, "k"), dtype=np.float64)
    if not matrix.any():
        raise DataError("the camera is not calibrated: its matrix K is zero")
    projection = np.array(_field(info, "p"), dtype=np.float64).reshape(3, 4)
    if rectified and projection[:, :3].any():
        matrix = projection[:, :3].ravel()
    camera = Camera(int(info.width), int(info.height), *intrinsics_of(matrix))
    return Lens(camera, None if rectified else _distortion(info))


def _distortion(info: Any) -> Distortion | None:
    coefficients = [float(value) for value in _field(info, "d")]
    model = str(info.distortion_model)
    if model == "equidistant":
        return KannalaBrandt(tuple(coefficients))
    if model in ("plumb_bob", "rational_polynomial") or not any(coefficients):
        return brown_conrady(coefficients)
    raise DataError(
        f"the distortion model '{model}' is not supported; there are plumb_bob, "
        "rational_polynomial and equidistant"
    )


def _field(info: Any, name: str) -> Any:
    return getattr(info, name if hasattr(info, name) else name.upper())
