"""Measured data: frames, observations that preprocessors make of them, landmarks, true joints."""

from regkit.geometry.camera import Camera
from regkit.observation.frame import Frame
from regkit.observation.keypoints import Keypoints
from regkit.observation.landmarks import Landmarks
from regkit.observation.observation import Observation
from regkit.observation.placed_camera import PlacedCamera
from regkit.observation.sight import Sight
from regkit.observation.silhouette import Silhouette
from regkit.observation.timed_frame import TimedFrame
from regkit.observation.truth import Truth
from regkit.observation.view import View

__all__ = [
    "Camera",
    "Frame",
    "Keypoints",
    "Landmarks",
    "Observation",
    "PlacedCamera",
    "Sight",
    "Silhouette",
    "TimedFrame",
    "Truth",
    "View",
]
