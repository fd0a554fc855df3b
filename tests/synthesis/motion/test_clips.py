"""Recorded body motion is read as it was meant, runs smoothly, and arrives on the mesh."""

from __future__ import annotations

import itertools
import json
from dataclasses import replace

import numpy as np
import pytest

from regkit.geometry.rotation import (
    IDENTITY,
    conjugate,
    from_vector,
    product,
    to_vector,
    vector_to_matrix,
)
from regkit.system.errors import DataError
from regkit_synthesis import assets
from regkit_synthesis.bodies.bodies import human_landmarks
from regkit_synthesis.bodies.body_map import body_map
from regkit_synthesis.bodies.landmarks import placed
from regkit_synthesis.bodies.retarget import Retarget
from regkit_synthesis.motion.clip import RIG, read_clip, with_arms_turned_out
from regkit_synthesis.motion.mending import interpolated
from regkit_synthesis.motion.motion import SourcePose
from regkit_synthesis.motion.shipped import shipped_clip

CLIPS = ("walk", "run", "jump", "punch", "kick", "dance_a", "dance_b")
UPRIGHT = SourcePose(np.array([0.0, 0.0, 0.8]), {joint: np.eye(3) for joint in RIG.parents})


def _clip(name):
    return read_clip(assets.ASSETS / "humanoid_pybullet" / f"humanoid3d_{name}.txt")


@pytest.fixture(scope="module")
def body():
    return Retarget.of(RIG, assets.average_human(), body_map("anny_cmu"))


def _angle(first, second):
    cosine = first @ second / (np.linalg.norm(first) * np.linalg.norm(second))
    return np.arccos(np.clip(cosine, -1.0, 1.0))


def _segment(poses, mesh, start, end):
    return poses[mesh.bone(end), :3, 3] - poses[mesh.bone(start), :3, 3]


@pytest.mark.parametrize("name", CLIPS)
def test_clip_has_unit_quaternions_and_starts_at_zero(name):
    clip = _clip(name)
    assert clip.times[0] == 0.0
    assert (np.diff(clip.times) > 0.0).all()
    assert np.allclose(np.linalg.norm(clip.joints, axis=-1), 1.0)


def test_clip_at_the_time_of_a_row_is_the_row():
    clip = _clip("dance_a")
    assert np.allclose(clip.at(float(clip.times[7])).root, clip.roots[7])


def test_looping_clip_walks_on_without_a_jump():
    clip = _clip("walk")
    period = float(clip.times[-1])
    before, after = clip.at(period - 1e-9), clip.at(period + 1e-9)
    assert np.allclose(before.root, after.root, atol=1e-6)
    for segment in RIG.parents:
        assert np.allclose(before.rotations[segment], after.rotations[segment], atol=1e-6)
    assert np.allclose(
        clip.at(2.5 * period).root - clip.at(0.5 * period).root, [0, -2.478, 0], atol=1e-3
    )


def test_clip_that_does_not_loop_holds_its_ends():
    clip = _clip("punch")
    assert np.allclose(clip.at(-1.0).root, clip.roots[0])
    assert np.allclose(clip.at(1e3).root, clip.roots[-1])


def test_bridged_removes_the_jump_and_leaves_the_rest():
    clip = _clip("walk")
    bridged = clip.bridged(18)
    shoulder = list(RIG.parents).index("left_shoulder")

    def step(joints):
        return 2.0 * np.arccos(np.clip(abs(joints[18, shoulder] @ joints[19, shoulder]), 0.0, 1.0))

    assert step(clip.joints) > 0.4
    assert step(bridged.joints) < 0.07
    assert np.array_equal(bridged.joints[:8], clip.joints[:8])
    assert np.array_equal(bridged.joints[30:], clip.joints[30:])


def _steps(clip):
    """How far each joint turns from row to row [rad]."""
    return np.linalg.norm(to_vector(product(conjugate(clip.joints[:-1]), clip.joints[1:])), axis=-1)


@pytest.mark.parametrize("name", CLIPS)
def test_shipped_clips_have_no_jumps_left(name):
    clip = shipped_clip(name)
    steps = _steps(clip)
    # No step is far larger than both of its neighbours.
    beside = np.maximum(steps[:-2], steps[2:])
    assert (steps[1:-1] - beside).max() < 0.32
    # An elbow that punches and a knee that kicks are the fastest.
    assert (steps / np.diff(clip.times)[:, None]).max() < {"punch": 28.0}.get(name, 22.0)


def test_smoothed_leaves_a_steady_turn_and_the_ends():
    clip = _clip("kick")
    angles = np.zeros((len(clip.times), 13, 3))
    angles[:, 4, 2] = 0.1 * np.arange(len(clip.times))
    steady = replace(clip, joints=from_vector(angles))
    assert np.allclose(steady.smoothed().joints, steady.joints, atol=1e-12)
    smooth = clip.smoothed()
    assert np.array_equal(smooth.joints[[0, -1]], clip.joints[[0, -1]])
    shaking = np.abs(np.diff(_steps(clip), axis=0)).max()
    assert np.abs(np.diff(_steps(smooth), axis=0)).max() < 0.7 * shaking


def test_looped_goes_on_from_its_beginning():
    clip = _clip("punch").looped()
    period = float(clip.times[-1])
    before, after = clip.at(period - 1e-9), clip.at(period + 1e-9)
    assert np.allclose(before.root, after.root, atol=1e-6)
    for segment in RIG.parents:
        assert np.allclose(before.rotations[segment], after.rotations[segment], atol=1e-6)


def test_arms_turned_out_move_bent_forearms_apart_and_no_elbow(body):
    clip = _clip("punch")
    distances = []
    for played in (clip, with_arms_turned_out(clip, 0.4)):
        poses, mesh = body.bone_poses(played.at(0.3)), body.mesh
        elbows, wrists = (
            np.array([poses[mesh.bone(side + bone), :3, 3] for side in ("Left", "Right")])
            for bone in ("ForeArm", "Hand")
        )
        distances.append([np.linalg.norm(pair[0] - pair[1]) for pair in (elbows, wrists)])
    (elbows, wrists), (elbows_out, wrists_out) = distances
    assert elbows_out == pytest.approx(elbows, abs=1e-9)
    assert wrists_out > wrists + 0.05


def test_interpolated_goes_the_short_way_at_constant_speed():
    goal = -np.array([0.0, 0.0, np.sin(0.4), np.cos(0.4)])
    halfway = interpolated(IDENTITY, goal, 0.25)
    assert np.allclose(halfway, [0.0, 0.0, np.sin(0.1), np.cos(0.1)])


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("no json", "not JSON"),
        ('{"Loop": "wrap"}', "Frames"),
        (json.dumps({"Loop": "none", "Frames": [[0.1] * 43] * 3}), "2 or more rows of 44 numbers"),
    ],
)
def test_clip_refuses_a_wrong_file(tmp_path, text, message):
    path = tmp_path / "clip.txt"
    path.write_text(text)
    with pytest.raises(DataError, match=message):
        read_clip(path)


@pytest.mark.parametrize("duration", [0.0, -0.1, 1.7e10])
def test_clip_refuses_a_row_of_no_time_or_of_years(tmp_path, duration):
    row = [0.1, 0.0, 0.0, 1.0, *np.zeros(40)]
    text = json.dumps({"Loop": "none", "Frames": [row, [duration, *row[1:]], row]})
    path = tmp_path / "clip.txt"
    path.write_text(text)
    with pytest.raises(DataError, match="row 1 of Frames lasts"):
        read_clip(path)


def test_clip_names_a_missing_file(tmp_path):
    with pytest.raises(DataError, match=r"none\.txt: there is no such file"):
        read_clip(tmp_path / "none.txt")


def test_body_stands_upright_in_the_zero_pose(body):
    poses, mesh = body.bone_poses(UPRIGHT), body.mesh
    for side in ("Left", "Right"):
        for chain in (("Arm", "ForeArm", "Hand"), ("UpLeg", "Leg", "Foot")):
            for start, end in itertools.pairwise(chain):
                direction = _segment(poses, mesh, side + start, side + end)
                assert np.allclose(direction / np.linalg.norm(direction), [0, 0, -1], atol=1e-6)
        foot = _segment(poses, mesh, side + "Foot", side + "ToeBase")
        assert abs(foot[0]) < 1e-6
        assert foot[1] < -0.1  # The toes point forward.


def test_body_bends_as_the_clip_does(body):
    bend = vector_to_matrix(np.array([-0.7, 0.0, 0.0]))
    rotations = {**UPRIGHT.rotations, "left_elbow": bend, "right_knee": bend.T}
    poses, mesh = body.bone_poses(SourcePose(UPRIGHT.root, rotations)), body.mesh
    forearm = _segment(poses, mesh, "LeftForeArm", "LeftHand")
    shin = _segment(poses, mesh, "RightLeg", "RightFoot")
    assert forearm[1] < 0.0 < shin[1]  # The forearm swings forward, the shin backward.
    for bone in (forearm, shin):
        assert _angle(bone, np.array([0.0, 0.0, -1.0])) == pytest.approx(0.7, abs=1e-6)


@pytest.mark.parametrize("name", CLIPS)
def test_body_keeps_its_bone_lengths(body, name):
    clip, mesh = _clip(name), body.mesh
    bones = np.arange(1, len(mesh.labels))
    rest = np.linalg.norm(mesh.rest[bones, :3, 3] - mesh.rest[mesh.parents[bones], :3, 3], axis=1)
    for time in (0.0, 0.4, 1.1):
        origins = body.bone_poses(clip.at(time))[:, :3, 3]
        lengths = np.linalg.norm(origins[bones] - origins[mesh.parents[bones]], axis=1)
        assert np.allclose(lengths, rest, atol=1e-12)


def test_body_hips_follow_the_scaled_root(body):
    pose = _clip("walk").at(0.3)
    landmarks = human_landmarks(body.mesh)
    poses = body.bone_poses(pose)
    pelvis = placed(landmarks, body.mesh, poses)[list(landmarks).index("pelvis")]
    assert np.allclose(pelvis, body.scale * pose.root, atol=1e-6)
