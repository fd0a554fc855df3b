"""Depth cameras: intrinsics of known models, what they see of meshes, and their noise."""

from regkit.sensors.cameras import CAMERAS, CameraChoice, CameraName, camera_of
from regkit.sensors.raycast import RayCaster, View, nearest, ray_cast, stored
from regkit.sensors.sensor import Sensor

__all__ = [
    "CAMERAS",
    "CameraChoice",
    "CameraName",
    "RayCaster",
    "Sensor",
    "View",
    "camera_of",
    "nearest",
    "ray_cast",
    "stored",
]
