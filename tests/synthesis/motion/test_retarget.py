"""Whatever moves a body, it moves as a body does, and as its source does."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from motion_cases import BODIES, LIMBS, SOURCES, body, joints, motion, retarget, unit
from places import ASSETS, REFERENCE

from regkit.geometry.rotation import vector_to_matrix
from regkit_synthesis.assets import average_human
from regkit_synthesis.bodies.body_map import Between, body_map
from regkit_synthesis.bodies.retarget import Retarget, retargeted
from regkit_synthesis.motion.motion import SourcePose
from regkit_synthesis.motion.shipped import shipped_clip

PAIRS = [(name, source) for name in BODIES for source in SOURCES]


@pytest.fixture(params=PAIRS, ids=["-".join(pair) for pair in PAIRS])
def pair(request):
    name, source = request.param
    for config in (BODIES[name], SOURCES[source]):
        path = getattr(config, "path", None)
        if path is not None and not path.is_file():
            pytest.skip(f"the reference data are not at {REFERENCE}")
    return request.param


def _times(source):
    return np.linspace(0.0, motion(source).duration, 5)


def test_bones_keep_their_lengths(pair):
    mesh, moved = body(pair[0]).mesh, retarget(*pair)
    bones = np.arange(1, len(mesh.labels))
    parents = mesh.parents[bones]
    rest = np.linalg.norm(mesh.rest[bones, :3, 3] - mesh.rest[parents, :3, 3], axis=1)
    for time in _times(pair[1]):
        origins = moved.bone_poses(motion(pair[1]).at(time))[:, :3, 3]
        lengths = np.linalg.norm(origins[bones] - origins[parents], axis=1)
        assert np.allclose(lengths, rest, atol=1e-9)


def test_limbs_point_where_those_of_the_source_do_at_rest(pair):
    human, moved, rig = body(pair[0]), retarget(*pair), motion(pair[1]).rig
    still = SourcePose(np.zeros(3), dict.fromkeys(rig.parents, np.eye(3)))
    places, source = joints(human, moved.bone_poses(still)), rig.figure
    for start, end in LIMBS:
        if end in source:
            expected = unit(source[end] - source[start])
            assert np.allclose(unit(places[end] - places[start]), expected, atol=1e-6)
    level = np.array([1.0, 1.0, 0.0])
    for side in ("left", "right"):
        toes = (places[f"{side}_foot"] - places[f"{side}_ankle"]) * level
        expected = (source[f"{side}_foot"] - source[f"{side}_ankle"]) * level
        assert np.allclose(unit(toes), unit(expected), atol=1e-6)


def test_limbs_point_where_those_of_the_source_do_at_any_time(pair):
    human, moved, rig = body(pair[0]), retarget(*pair), motion(pair[1]).rig
    for time in _times(pair[1]):
        pose = motion(pair[1]).at(time)
        places = joints(human, moved.bone_poses(pose))
        for start, end in LIMBS:
            if end in rig.figure:
                rest = rig.figure[end] - rig.figure[start]
                expected = unit(pose.rotations[rig.parts[start]] @ rest)
                assert np.allclose(unit(places[end] - places[start]), expected, atol=1e-6)


def test_turned_source_gives_the_turned_body(pair):
    moved, pose = retarget(*pair), motion(pair[1]).at(0.4)
    turn = vector_to_matrix(np.array([0.0, 0.0, 1.1]))
    turned = SourcePose(turn @ pose.root, {j: turn @ r for j, r in pose.rotations.items()})
    expected = moved.bone_poses(pose)
    expected[:, :3] = turn @ expected[:, :3]
    assert np.allclose(moved.bone_poses(turned), expected, atol=1e-9)


def test_hips_go_the_way_of_the_source_by_the_length_of_the_legs(pair):
    human, moved = body(pair[0]), retarget(*pair)
    legs = []
    for places in ({n: m.position for n, m in human.landmarks.items()}, motion(pair[1]).rig.figure):
        hip, knee, ankle = (places[f"left_{joint}"] for joint in ("hip", "knee", "ankle"))
        legs.append(np.linalg.norm(knee - hip) + np.linalg.norm(ankle - knee))
    for time in _times(pair[1]):
        pose = motion(pair[1]).at(time)
        places = joints(human, moved.bone_poses(pose))
        middle = (places["left_hip"] + places["right_hip"]) / 2
        assert np.allclose(middle, legs[0] / legs[1] * pose.root, atol=1e-6)


def test_body_stands_on_the_ground_and_looks_ahead(pair):
    human = body(pair[0])
    moved = human.moved(motion(pair[1]))
    places = joints(human, moved(0.0))
    for joint in ("hip", "shoulder"):
        assert places[f"left_{joint}"][0] > places[f"right_{joint}"][0] + 0.05
    assert places["head"][2] > places["pelvis"][2] + 0.2
    lowest = [human.mesh.posed(moved(time))[:, 2].min() for time in _times(pair[1])]
    assert min(lowest) > -0.03
    # A run and jumps leave the ground; nothing else does by more than a step's roll.
    assert max(lowest) < (0.4 if pair[1] == "clip" else 0.13)


def test_lowest_point_of_the_skin_lies_on_the_ground():
    human, kneel = body("average"), motion("biovision")
    moved = human.moved(kneel)
    times = np.linspace(0.0, kneel.duration, 40)
    assert min(human.mesh.posed(moved(time))[:, 2].min() for time in times) == pytest.approx(0.0)


@pytest.mark.parametrize("name", ["walk", "run", "jump", "punch", "kick", "dance_a", "dance_b"])
def test_declared_map_moves_clips_as_the_special_retargeting_did(name):
    """What was computed before retargeting had a map, from bone names in its code."""
    golden = np.load(ASSETS / "retargeted_clips.npz")
    moved = retargeted(shipped_clip(name), average_human(), body_map("anny_cmu"))
    for time, expected in zip(golden[f"{name}_times"], golden[f"{name}_poses"], strict=True):
        assert np.allclose(moved(time)[:, :3], expected, atol=1e-6)


def test_bones_that_the_map_does_not_name_follow_their_parents():
    human = body("average")
    moved = retarget("average", "mixamo").bone_poses(motion("mixamo").at(0.5))
    mesh = human.mesh
    thumb, hand = mesh.bone("LThumb"), mesh.bone("LeftHand")
    assert "LThumb" not in human.map.bones
    relative = np.linalg.inv(moved[hand]) @ moved[thumb]
    assert np.allclose(relative, np.linalg.inv(mesh.rest[hand]) @ mesh.rest[thumb], atol=1e-9)


def test_forearm_takes_a_part_of_the_twist_of_the_hand_and_no_bend():
    human, rig = body("average"), motion("keyframes").rig
    bones = {
        **human.map.bones,
        "LeftForeArm": Between(between=("left_elbow", "left_wrist"), share=0.5, only_twist=True),
    }
    twisted = Retarget.of(rig, human.mesh, human.map.model_copy(update={"bones": bones}))
    still = dict.fromkeys(rig.parents, np.eye(3))
    bone = human.mesh.bone("LeftForeArm")
    rest = twisted.bone_poses(SourcePose(np.zeros(3), still))[bone, :3, :3]
    # The arm hangs, so that its bones' axes are about the vertical, and the wrist's bend is not.
    for angles, part in (((0.0, 0.0, 0.8), 0.4), ((0.5, 0.0, 0.0), 0.0)):
        pose = SourcePose(np.zeros(3), {**still, "left_wrist": vector_to_matrix(np.array(angles))})
        turned = twisted.bone_poses(pose)[bone, :3, :3]
        expected = vector_to_matrix(np.array([0.0, 0.0, part])) @ rest
        assert np.abs(turned - expected).max() < 0.03


def test_map_may_declare_how_far_the_hips_go():
    human, source = body("average"), motion("mixamo")
    declared = human.map.model_copy(update={"root_scale": 0.5})
    moved = replace(human, map=declared)
    ways = [
        joints(figure, retargeted(source, figure.mesh, figure.map)(1.0))["pelvis"]
        - joints(figure, retargeted(source, figure.mesh, figure.map)(0.0))["pelvis"]
        for figure in (human, moved)
    ]
    scale = retarget("average", "mixamo").scale
    assert np.allclose(ways[1] * scale, ways[0] * 0.5, atol=1e-6)
