"""Depth cameras: intrinsics of known models, what they see of meshes, and their noise."""

from regkit.sensors.cameras import CAMERAS, CameraChoice, CameraName, camera_of
from regkit.sensors.raycast import RayCaster, View, nearest, ray_cast, stored

__all__ = [
    "CAMERAS",
    "CameraChoice",
    "CameraName",
    "RayCaster",
    "View",
    "camera_of",
    "nearest",
    "ray_cast",
    "stored",
]
