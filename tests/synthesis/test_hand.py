"""Recorded hand poses are read as they were meant, and arrive on the mesh."""

from __future__ import annotations

import itertools

import numpy as np
import pytest

from regkit.system.errors import DataError
from regkit_synthesis.assets import average_hand, slim_hand
from regkit_synthesis.bodies.landmarks import hand_landmarks, placed
from regkit_synthesis.hands.config import GESTURES, GesturesConfig
from regkit_synthesis.hands.gestures import Gestures
from regkit_synthesis.hands.handywork import read_handywork
from regkit_synthesis.hands.iwer import read_iwer
from regkit_synthesis.hands.pose import CHAINS, PARENTS, WRIST
from regkit_synthesis.hands.retarget import HandRetarget
from regkit_synthesis.hands.shipped import pose_names, shipped_pose

POSES = ("relaxed", "point", "pinch")
HANDYWORK = ("fist", "flat", "horns", "point", "relax", "shaka", "vulcan")


def iwer(name):
    return shipped_pose(f"iwer/{name}")


def handywork(name):
    return shipped_pose(f"handywork/{name}")


@pytest.fixture(scope="module")
def hand():
    return HandRetarget.of(average_hand(), iwer("relaxed"))


def _angle(first, second):
    cosine = first @ second / (np.linalg.norm(first) * np.linalg.norm(second))
    return np.arccos(np.clip(cosine, -1.0, 1.0))


def test_hand_pose_is_of_a_right_hand():
    for name in POSES:
        origins = iwer(name).origins
        knuckle = origins["index-finger-phalanx-proximal"]
        little = origins["pinky-finger-phalanx-proximal"]
        assert (
            knuckle[0] < little[0]
        )  # Palm down, the little finger of a right hand is to the right.
        assert knuckle[2] < -0.05  # The fingers point forward, along -z.


def test_gestures_pass_through_their_poses():
    poses = tuple(iwer(name) for name in POSES)
    gestures = Gestures(np.array([0.0, 1.0, 2.0]), poses)
    for time, pose in [(-1.0, 0), (0.0, 0), (1.0, 1), (2.0, 2), (5.0, 2)]:
        for joint, rotation in poses[pose].rotations().items():
            assert np.allclose(gestures.at(time)[joint], rotation, atol=1e-9)


def test_gestures_move_smoothly():
    gestures = Gestures(np.array([0.0, 0.5, 1.0]), tuple(iwer(name) for name in POSES))
    times = np.linspace(0.0, 1.0, 201)
    tips = np.array([gestures.at(time)["index-finger-tip"] for time in times])
    steps = np.linalg.norm(np.diff(tips, axis=0), axis=(1, 2))
    assert steps.max() < 0.1
    assert np.abs(np.diff(steps)).max() < 0.005


@pytest.mark.parametrize("name", POSES)
def test_fingers_bend_as_recorded(hand, name):
    rotations = iwer(name).rotations()
    poses, mesh = hand.bone_poses(rotations, np.eye(4)), hand.mesh
    for number, chain in enumerate(CHAINS.values(), start=1):
        joints = chain[-4:-1]
        for part, (near, far) in enumerate(itertools.pairwise(joints), start=1):
            recorded = _angle(rotations[near][:, 2], rotations[far][:, 2])
            bones = [mesh.bone(f"finger{number}-{part + k}.R") for k in (0, 1)]
            assert _angle(*poses[bones, :3, 1]) == pytest.approx(recorded, abs=1e-3)


def test_fist_curls_towards_the_palm(hand):
    poses, mesh = hand.bone_poses(iwer("point").rotations(), np.eye(4)), hand.mesh
    for finger in (3, 4, 5):
        bone = poses[mesh.bone(f"finger{finger}-2.R")]
        assert bone[1, 3] < -0.02  # y points out of the back of the hand.
        assert bone[2, 1] > 0.5  # The middle bone points back to the wrist.


def test_hand_pose_names_missing_joints(tmp_path):
    path = tmp_path / "empty.js"
    path.write_text("export const empty = {};")
    with pytest.raises(DataError, match="no offsetMatrix for wrist"):
        read_iwer(path)
    assert len(PARENTS) == 24


def test_hand_pose_refuses_a_short_matrix(tmp_path):
    path = tmp_path / "short.js"
    path.write_text("wrist: { offsetMatrix: [1, 2, 3], radius: 1 }")
    with pytest.raises(DataError, match="not 16 numbers"):
        read_iwer(path)


@pytest.mark.parametrize("name", HANDYWORK)
def test_handywork_poses_are_rotations_of_a_right_hand(name):
    pose = handywork(name)
    turns = np.array(list(pose.rotations().values()))
    assert np.allclose(turns @ turns.transpose(0, 2, 1), np.eye(3), atol=1e-9)
    assert np.allclose(np.linalg.det(turns), 1.0)
    index, little = (
        pose.origins[f"{finger}-finger-phalanx-proximal"] for finger in ("index", "pinky")
    )
    assert index[0] < little[0]
    assert index[2] < -0.05


@pytest.mark.parametrize("name", HANDYWORK)
def test_handywork_has_the_hand_and_the_axes_of_iwer(name):
    pose, known = handywork(name), iwer("relaxed")
    rotations = pose.rotations()
    for chain in CHAINS.values():
        for near, far in itertools.pairwise(chain[-4:]):
            bone = pose.origins[far] - pose.origins[near]
            if near.endswith("proximal") or near.endswith("intermediate"):
                assert _angle(bone, -rotations[near][:, 2]) < 0.1
                expected = np.linalg.norm(known.origins[far] - known.origins[near])
                assert np.linalg.norm(bone) == pytest.approx(expected, abs=2e-4)


def test_handywork_refuses_another_file(tmp_path):
    path = tmp_path / "short.handpose"
    with pytest.raises(DataError, match=r"short\.handpose: there is no such file"):
        read_handywork(path)
    np.array([25.0] * 100, dtype="<f4").tofile(path)
    with pytest.raises(DataError, match="must have 851"):
        read_handywork(path)


def test_changed_poses_keep_the_bones_as_long_as_they_are():
    flat, fist = handywork("flat"), handywork("fist")
    for pose in (
        fist.with_thumb_of(flat),
        fist.with_thumb_lifted(0.5),
        fist.with_fingers_towards(flat, 0.3),
    ):
        for joint, parent in PARENTS.items():
            before = np.linalg.norm(fist.origins[joint] - fist.origins[parent])
            after = np.linalg.norm(pose.origins[joint] - pose.origins[parent])
            assert after == pytest.approx(before, abs=1e-9)


def test_changed_poses_change_what_they_say():
    flat, fist = handywork("flat"), handywork("fist")
    thumb = np.array([joint in CHAINS["thumb"] for joint in PARENTS])
    mixed = fist.with_thumb_of(flat)
    assert np.array_equal(mixed.joints[thumb], flat.joints[thumb])
    assert np.array_equal(mixed.joints[~thumb], fist.joints[~thumb])
    opened = fist.with_fingers_towards(flat, 1.0)
    assert np.array_equal(opened.joints[thumb], fist.joints[thumb])
    assert np.allclose(abs((opened.joints * flat.joints).sum(axis=1))[~thumb], 1.0)
    lifted = fist.with_thumb_lifted(0.3)
    assert np.array_equal(lifted.joints[~thumb], fist.joints[~thumb])
    # y points out of the back of the hand.
    assert lifted.origins["thumb-tip"][1] < fist.origins["thumb-tip"][1] - 0.015
    assert lifted.origins[WRIST] == pytest.approx(fist.origins[WRIST])


@pytest.mark.parametrize("make", [average_hand, slim_hand])
@pytest.mark.parametrize("name", GESTURES.names)
def test_fingers_of_shipped_gestures_keep_out_of_each_other(make, name):
    """Bones of fingers touch at some 14 mm; of fingertips that pinch at half of that."""
    mesh, gestures = make(), GesturesConfig(name=name).motion().gestures
    landmarks = hand_landmarks(mesh)
    motion = HandRetarget.of(mesh, gestures.poses[0])
    for time in np.arange(0.0, gestures.times[-1], 0.1):
        positions = placed(landmarks, mesh, motion.bone_poses(gestures.at(time), np.eye(4)))
        # Points along the two last bones of each finger; the wrist comes first.
        fingers = positions[1:].reshape(5, 4, 3)
        steps = np.linspace(0.0, 1.0, 9)[:, None, None, None]
        along = (1.0 - steps) * fingers[:, 1:-1] + steps * fingers[:, 2:]
        points = np.moveaxis(along, 0, 1).reshape(5, -1, 3)
        for one, other in itertools.combinations(points, 2):
            gap = np.linalg.norm(one[:, None] - other[None], axis=-1).min()
            assert gap > (0.006 if name == "point_and_pinch" else 0.008)


def test_every_pose_that_ships_is_named():
    assert pose_names() == [
        *(f"handywork/{name}" for name in HANDYWORK),
        *(f"iwer/{name}" for name in sorted(POSES)),
    ]


def test_palm_that_does_not_sway_is_held_before_the_camera():
    motion = GesturesConfig(name="signs", sway=0.0).motion()
    assert np.array_equal(motion.palm(0.0), motion.palm(0.7))
    assert motion.palm(0.0)[:3, 2] == pytest.approx([0.0, 0.0, -1.0])  # The fingers point up.
    swaying = GesturesConfig(name="signs").motion()
    middles = np.array([swaying.palm(t) @ [0, 0, -0.08, 1] for t in np.linspace(0.0, 2.0, 50)])
    assert np.abs(middles[:, :3]).max() < 0.031


def test_poses_written_out_are_those_that_they_say():
    fist, flat = handywork("fist"), handywork("flat")
    poses = [
        {"time": 0, "pose": "handywork/fist", "opened": 0.5, "thumb": "handywork/flat"},
        {"time": 1, "pose": "handywork/fist", "thumb_lift_deg": 10},
    ]
    first, second = GesturesConfig(poses=poses).motion().gestures.poses
    assert np.array_equal(
        first.joints, fist.with_fingers_towards(flat, 0.5).with_thumb_of(flat).joints
    )
    assert np.array_equal(second.joints, fist.with_thumb_lifted(np.radians(10.0)).joints)


@pytest.mark.parametrize(
    ("config", "words"),
    [
        ({"name": "fits"}, "fists"),
        ({}, "path or a name"),
        ({"poses": [{"time": 0, "pose": "iwer/piont"}] * 2}, "iwer/point"),
        ({"poses": [{"time": 1, "pose": "iwer/point"}] * 2}, "must increase"),
        ({"name": "fists", "path": "a.yaml"}, "path or a name"),
    ],
)
def test_mistake_about_gestures_is_answered(config, words):
    with pytest.raises(ValueError, match=words):
        GesturesConfig.model_validate(config)
