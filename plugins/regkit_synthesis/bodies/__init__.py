"""Rigged bodies: meshes, joints, and retargeting of motion to their bones."""

from regkit_synthesis.bodies.bodies import AnyBody, BodyFile, HumanBody, ShippedBody
from regkit_synthesis.bodies.body_map import BodyMap, body_map
from regkit_synthesis.bodies.hand import HandBody, ShippedHand
from regkit_synthesis.bodies.landmarks import Landmark, hand_landmarks, placed
from regkit_synthesis.bodies.movable import MovableBody
from regkit_synthesis.bodies.retarget import Retarget, retargeted

__all__ = [
    "AnyBody",
    "BodyFile",
    "BodyMap",
    "HandBody",
    "HumanBody",
    "Landmark",
    "MovableBody",
    "Retarget",
    "ShippedBody",
    "ShippedHand",
    "body_map",
    "hand_landmarks",
    "placed",
    "retargeted",
]
