"""Depth cameras: intrinsics of known models, viewpoints, and ray casting of meshes."""

from regkit_synthesis.cameras.cameras import CAMERAS, CameraChoice, CameraName, camera_of
from regkit_synthesis.cameras.raycast import RayCaster, View, nearest, ray_cast, stored
from regkit_synthesis.cameras.viewpoint import Viewpoint

__all__ = [
    "CAMERAS",
    "CameraChoice",
    "CameraName",
    "RayCaster",
    "View",
    "Viewpoint",
    "camera_of",
    "nearest",
    "ray_cast",
    "stored",
]
