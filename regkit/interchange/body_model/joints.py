"""The joints of known body models: the files number them, and their papers name them.

Sources: Loper et al., SMPL, 2015; Romero, Tzionas, Black, Embodied Hands (SMPL-H, MANO), 2017;
Pavlakos et al., SMPL-X, 2019; Li et al., FLAME, 2017. A name is that of the joint at the start of
the part that it moves.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence

Tree = Mapping[str, str | None]
"""The parent of each joint, in the order of the file; None for the root."""

_BODY: Tree = {
    "pelvis": None,
    "left_hip": "pelvis",
    "right_hip": "pelvis",
    "spine1": "pelvis",
    "left_knee": "left_hip",
    "right_knee": "right_hip",
    "spine2": "spine1",
    "left_ankle": "left_knee",
    "right_ankle": "right_knee",
    "spine3": "spine2",
    "left_foot": "left_ankle",
    "right_foot": "right_ankle",
    "neck": "spine3",
    "left_collar": "spine3",
    "right_collar": "spine3",
    "head": "neck",
    "left_shoulder": "left_collar",
    "right_shoulder": "right_collar",
    "left_elbow": "left_shoulder",
    "right_elbow": "right_shoulder",
    "left_wrist": "left_elbow",
    "right_wrist": "right_elbow",
}


def _fingers(side: str = "") -> Tree:
    wrist = f"{side}wrist"
    tree: dict[str, str | None] = {}
    for finger in ("index", "middle", "pinky", "ring", "thumb"):
        names = [f"{side}{finger}{number}" for number in (1, 2, 3)]
        tree |= zip(names, [wrist, *names], strict=False)
    return tree


_HANDS = {**_fingers("left_"), **_fingers("right_")}

FAMILIES: Mapping[str, Tree] = {
    "SMPL": {**_BODY, "left_hand": "left_wrist", "right_hand": "right_wrist"},
    "SMPL-H": {**_BODY, **_HANDS},
    "SMPL-X": {**_BODY, "jaw": "head", "left_eye": "head", "right_eye": "head", **_HANDS},
    "MANO": {"wrist": None, **_fingers()},
    "FLAME": {
        "root": None,
        "neck": "root",
        "jaw": "neck",
        "left_eye": "neck",
        "right_eye": "neck",
    },
}
"""The joints of each family of models. STAR has those of SMPL."""

HUMAN = frozenset({"SMPL", "SMPL-H", "SMPL-X"})
"""Families of whole bodies, in a T-pose."""

EXPRESSIVE = frozenset({"SMPL-X", "FLAME"})
"""Families with modes of the facial expression behind those of the shape."""


def family_of(parents: Sequence[int]) -> str | None:
    """Returns the family with a tree of joints; None if it is of no known model.

    Args:
        parents: Index of each joint's parent, (J,); -1 for the root.
    """
    for family, tree in FAMILIES.items():
        names = list(tree)
        known = [-1 if above is None else names.index(above) for above in tree.values()]
        if known == list(parents):
            return family
    return None


def shape_count(family: str | None, modes: int) -> int:
    """Returns how many of a file's modes are of the shape; the others are of the expression.

    Source: the package ``smplx``, ``body_models.py``: 300 and 100, or in older files 10 and 10.

    Args:
        family: The family of the model.
        modes: Number of modes in the file.
    """
    if family not in EXPRESSIVE:
        return modes
    return min(300 if modes >= 400 else 10, modes)
