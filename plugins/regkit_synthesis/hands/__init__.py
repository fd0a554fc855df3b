"""Hands: recorded poses (WebXR), the files that hold them, and gestures that run through them."""

from regkit_synthesis.hands.gestures import Gestures
from regkit_synthesis.hands.handywork import read_handywork
from regkit_synthesis.hands.iwer import read_iwer
from regkit_synthesis.hands.pose import CHAINS, PARENTS, WRIST, HandPose

__all__ = ["CHAINS", "PARENTS", "WRIST", "Gestures", "HandPose", "read_handywork", "read_iwer"]
