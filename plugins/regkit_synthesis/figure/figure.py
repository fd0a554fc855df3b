"""The joints of a human figure: the names by which sources of motion and bodies meet."""

from __future__ import annotations

from collections.abc import Collection, Mapping

import numpy as np

from regkit.system.arrays import Array
from regkit.system.errors import DataError
from regkit_synthesis.figure.names import instead_of

_SIDED = {
    "collar": "chest",
    "shoulder": "collar",
    "elbow": "shoulder",
    "wrist": "elbow",
    "hand": "wrist",
    "hip": "pelvis",
    "knee": "hip",
    "ankle": "knee",
    "foot": "ankle",
}

FIGURE: Mapping[str, str] = {
    "pelvis": "",
    "spine": "pelvis",
    "chest": "spine",
    "neck": "chest",
    "head": "neck",
    **{
        f"{side}_{joint}": f"{side}_{parent}" if parent in _SIDED else parent
        for side in ("left", "right")
        for joint, parent in _SIDED.items()
    },
}
"""Each joint's parent. A joint stands for the segment that it moves: a shoulder for the upper arm,
a wrist for the hand. ``hand`` is where the fingers begin, ``foot`` where the toes do; left is the
figure's own left."""

AIMS: Mapping[str, str] = {
    f"{side}_{joint}": f"{side}_{end}"
    for side in ("left", "right")
    for joint, end in (
        ("shoulder", "elbow"),
        ("elbow", "wrist"),
        ("wrist", "hand"),
        ("hip", "knee"),
        ("knee", "ankle"),
    )
}
"""The joint that a segment of a limb points to."""


def check_joints(joints: Collection[str]) -> None:
    """Refuse names that are no joints of a figure.

    Raises:
        ValueError: If one is none.
    """
    for joint in joints:
        if joint not in FIGURE:
            raise ValueError(f"a figure has no joint '{joint}'{instead_of(joint, FIGURE)}")


def figure_axes(places: Mapping[str, Array]) -> Array:
    """The axes (3, 3) ``R_ground_figure`` of a figure that stands somewhere at rest.

    Its own coordinate axes are the ground's in another order: up is the one that the way from the
    hips to the head is nearest to, left that of the way from the right hip to the left one. What
    this returns turns them to x left, y backward, z up.

    Args:
        places: (3,) where its hips and its head are, among others.

    Raises:
        DataError: If left and up are the same axis, as in a figure that does not stand or lie
            straight.
    """
    across = places["left_hip"] - places["right_hip"]
    height = places["head"] - (places["left_hip"] + places["right_hip"]) / 2
    left, up = _axis(across), _axis(height)
    if abs(left @ up) > 0.5:
        raise DataError(
            "at rest the hips lie above each other; a figure must stand straight along an axis"
        )
    return np.array([left, np.cross(up, left), up])


def leg_length(places: Mapping[str, Array]) -> float:
    """Length of the left thigh and shin [m], which motion is scaled by."""
    hip, knee, ankle = (places[f"left_{joint}"] for joint in ("hip", "knee", "ankle"))
    return float(np.linalg.norm(knee - hip) + np.linalg.norm(ankle - knee))


def _axis(direction: Array) -> Array:
    """The coordinate axis, with its sign, that is nearest to a direction (3,)."""
    nearest = int(np.argmax(np.abs(direction)))
    return np.asarray(np.copysign(1.0, direction[nearest]) * np.eye(3)[nearest])
