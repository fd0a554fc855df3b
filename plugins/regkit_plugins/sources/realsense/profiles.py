"""What a device tells about its depth images."""

from __future__ import annotations

from typing import Any

from regkit.geometry import Camera, Lens
from regkit.geometry.distortion import Distortion, KannalaBrandt
from regkit.system.errors import DataError
from regkit_plugins.sources.formats.lenses import brown_conrady
from regkit_plugins.sources.realsense.library import realsense

NEAR = 1e-6
"""Relative deviation from a whole number of units per metre that single precision explains."""


def depth_profiles(device: Any) -> list[tuple[Any, Any]]:
    """Returns the profiles of 16-bit depth images of a device, each with its sensor."""
    library = realsense()
    return [
        (sensor, profile.as_video_stream_profile())
        for sensor in device.query_sensors()
        for profile in sensor.get_stream_profiles()
        if profile.stream_type() == library.stream.depth and profile.format() == library.format.z16
    ]


def lens_of(profile: Any) -> Lens:
    """Returns the camera of a profile.

    Raises:
        DataError: If its distortion is not supported.
    """
    intrinsics = profile.get_intrinsics()
    camera = Camera(
        int(intrinsics.width),
        int(intrinsics.height),
        float(intrinsics.fx),
        float(intrinsics.fy),
        float(intrinsics.ppx),
        float(intrinsics.ppy),
    )
    return Lens(camera, _distortion(intrinsics.model, list(intrinsics.coeffs)))


def _distortion(model: Any, coefficients: list[float]) -> Distortion | None:
    """Returns the distortion; other models than two matter only if they distort.

    https://github.com/realsenseai/librealsense, ``rs2_project_point_to_pixel``.
    """
    known = realsense().distortion
    if model == known.kannala_brandt4:
        return KannalaBrandt(tuple(map(float, coefficients[:4])))
    if model == known.brown_conrady:
        return brown_conrady(coefficients)
    if model != known.none and any(coefficients):
        raise DataError(
            f"the depth images have the distortion '{model}' {coefficients}, which is not "
            "supported; there are Brown Conrady and Kannala Brandt"
        )
    return None


def scale_of(sensor: Any) -> float:
    """Returns the units per metre of a sensor's images.

    Cameras give the metres of a unit in single precision, 0.0010000000475 for a millimetre; a
    thousand units per metre are meant.

    Raises:
        DataError: If the sensor has no unit, or none that a depth can have.
    """
    option = realsense().option.depth_units
    unit = float(sensor.get_option(option)) if sensor.supports(option) else 0.0
    if not 1e-6 <= unit <= 1e3:
        raise DataError(f"the unit of depth is {unit:g} m")
    scale = 1.0 / unit
    whole = float(round(scale))
    return whole if abs(scale - whole) <= NEAR * scale else scale
