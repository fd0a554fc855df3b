"""Hand motion: recorded WebXR poses, their file formats, and gestures through poses."""

from regkit_synthesis.hands.config import GESTURES, GesturesConfig, HandsConfig
from regkit_synthesis.hands.gestures import Gestures
from regkit_synthesis.hands.motion import HandMotion
from regkit_synthesis.hands.pose import CHAINS, PARENTS, WRIST, HandPose
from regkit_synthesis.hands.retarget import HandRetarget
from regkit_synthesis.hands.shipped import pose_names, shipped_pose

__all__ = [
    "CHAINS",
    "GESTURES",
    "PARENTS",
    "WRIST",
    "Gestures",
    "GesturesConfig",
    "HandMotion",
    "HandPose",
    "HandRetarget",
    "HandsConfig",
    "pose_names",
    "shipped_pose",
]
