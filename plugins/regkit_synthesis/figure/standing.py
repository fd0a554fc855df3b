"""The rest pose of clips and keyframes: a figure that stands upright with hanging arms."""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np

from regkit.system.arrays import Array

_TRUNK = {"pelvis": 0.0, "spine": 0.12, "chest": 0.236151, "neck": 0.40, "head": 0.460045}
"""Heights above the centre of the hips [m]."""

_LIMBS = {
    "collar": (0.03, 0.02405, 0.46),
    "shoulder": (0.18311, 0.02405, 0.479651),
    "elbow": (0.18311, 0.02405, 0.204863),
    "wrist": (0.18311, 0.02405, -0.054084),
    "hand": (0.18311, 0.02405, -0.134084),
    "hip": (0.084887, 0.0, 0.0),
    "knee": (0.084887, 0.0, -0.421546),
    "ankle": (0.084887, 0.0, -0.831416),
    "foot": (0.084887, -0.13, -0.831416),
}
"""Joints of the left side."""


def _standing() -> dict[str, Array]:
    places = {joint: np.array([0.0, 0.0, height]) for joint, height in _TRUNK.items()}
    for side, mirror in (("left", np.ones(3)), ("right", np.array([-1.0, 1.0, 1.0]))):
        places |= {f"{side}_{joint}": mirror * place for joint, place in _LIMBS.items()}
    return places


STANDING: Mapping[str, Array] = _standing()
"""Positions (3,) [m] of the figure's joints relative to the centre of the hips; x left, y backward,
z up. The size is that of pybullet's humanoid.urdf scaled by a quarter; collars, hands and feet,
which that file lacks, are added."""
