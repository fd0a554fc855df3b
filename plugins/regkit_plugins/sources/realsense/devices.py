"""The cameras that are connected."""

from __future__ import annotations

from typing import Any

from regkit.system.errors import ConfigError, DataError
from regkit_plugins.sources.realsense.library import realsense


def connected(context: Any, serial: str) -> Any:
    """Returns the camera of a serial number, or the only one.

    Args:
        context: The ``context`` of pyrealsense2, which knows the cameras.
        serial: The serial number; empty for the only camera.

    Raises:
        DataError: If there is none.
        ConfigError: If there are several, and none is named.
    """
    place = f"realsense:{serial}" if serial else "realsense"
    devices = {serial_of(device): device for device in context.query_devices()}
    known = ", ".join(devices)
    if not devices:
        raise DataError(
            "no RealSense camera is connected, or its user may not open it (on Linux the udev "
            "rules of librealsense allow it)",
            place=place,
        )
    if serial:
        if serial not in devices:
            raise DataError(
                f"no camera of this serial number is connected (there are: {known})", place=place
            )
        return devices[serial]
    if len(devices) > 1:
        raise ConfigError(
            f"several cameras are connected: {known}; name one, as realsense:{next(iter(devices))}",
            place=place,
        )
    return next(iter(devices.values()))


def serial_of(device: Any) -> str:
    """Returns the serial number of a camera."""
    return _info(device, realsense().camera_info.serial_number) or "unknown"


def name_of(device: Any) -> str:
    """Returns the name of a camera's model with its serial number."""
    model = _info(device, realsense().camera_info.name) or "RealSense"
    return f"{model} {serial_of(device)}"


def _info(device: Any, what: Any) -> str:
    return str(device.get_info(what)) if device.supports(what) else ""
