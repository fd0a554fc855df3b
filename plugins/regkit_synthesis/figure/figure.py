"""The joints of the human figure, common to motion sources and bodies."""

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
"""Parent of each joint. A joint represents the segment that it moves: a shoulder the upper arm, a
wrist the hand. ``hand`` is at the base of the fingers, ``foot`` at the base of the toes. Left is
the figure's left."""

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
"""The joint at the far end of each limb segment."""


def check_joints(joints: Collection[str]) -> None:
    """Rejects names that are not joints of the figure.

    Raises:
        ValueError: If a name is unknown.
    """
    for joint in joints:
        if joint not in FIGURE:
            raise ValueError(f"a figure has no joint '{joint}'{instead_of(joint, FIGURE)}")


def figure_axes(places: Mapping[str, Array]) -> Array:
    """Returns the axes ``R_ground_figure`` (3, 3) of a figure at rest.

    The coordinate axes of the figure are a permutation of the ground's (x left, y backward, z up):
    up is nearest to the direction from the hips to the head, left to that from the right hip to the
    left one.

    Args:
        places: Positions (3,) by joint, with hips and head among them.

    Raises:
        DataError: If left and up are the same axis, because the figure is not upright.
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
    """Returns the length of the left thigh and shin [m], by which motion is scaled."""
    hip, knee, ankle = (places[f"left_{joint}"] for joint in ("hip", "knee", "ankle"))
    return float(np.linalg.norm(knee - hip) + np.linalg.norm(ankle - knee))


def _axis(direction: Array) -> Array:
    """Returns the signed coordinate axis that is nearest to a direction (3,)."""
    nearest = int(np.argmax(np.abs(direction)))
    return np.asarray(np.copysign(1.0, direction[nearest]) * np.eye(3)[nearest])
