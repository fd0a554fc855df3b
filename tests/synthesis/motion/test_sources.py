"""Motion from files is what the files say, in ground axes."""

from __future__ import annotations

import itertools

import numpy as np
import pytest
from motion_cases import body, joints, motion, unit
from places import REFERENCE

from regkit.geometry.rotation import vector_to_matrix
from regkit.interchange.bvh.bvh import Bvh
from regkit.interchange.gltf.gltf import RiggedBody
from regkit.system.errors import ConfigError, DataError
from regkit_synthesis.figure.figure import figure_axes
from regkit_synthesis.motion.bvh import read_bvh
from regkit_synthesis.motion.config import BvhConfig, ClipConfig, KeyframesConfig
from regkit_synthesis.motion.gltf import read_gltf
from regkit_synthesis.motion.played import Placed, Played
from regkit_synthesis.motion.shipped import BVH, CLIPS, KEYFRAMES

R_GROUND_FILE = np.array([[1.0, 0.0, 0.0], [0.0, 0.0, -1.0], [0.0, 1.0, 0.0]])
"""From x left, y up, z forward to x left, y backward, z up."""

CESIUM_MAN = REFERENCE / "cesiumman_ccby" / "CesiumMan.glb"


@pytest.mark.parametrize("name", BVH.names)
def test_bvh_motion_at_a_frame_is_that_frame(name):
    file, recording = Bvh.read(BVH.path(name), scale=0.01), read_bvh(BVH.path(name), scale=0.01)
    assert recording.duration == pytest.approx(file.duration)
    for frame in (0, 7, len(file.frames) - 1):
        pose, expected = recording.at(frame * file.frame_time), file.at_frame(frame)
        for joint, rotation in zip(file.names, expected.rotations, strict=True):
            assert np.allclose(
                pose.rotations[joint], R_GROUND_FILE @ rotation @ R_GROUND_FILE.T, atol=1e-6
            )
        hips = [file.names.index(recording.rig.parts[f"{side}_hip"]) for side in ("left", "right")]
        middle = expected.positions[hips].mean(axis=0)
        assert np.allclose(pose.root, R_GROUND_FILE @ middle, atol=1e-9)


def test_bvh_skips_frames():
    path = BVH.path("kneel")
    whole, rest = read_bvh(path), read_bvh(path, skip=10)
    assert len(rest.times) == len(whole.times) - 10
    assert np.allclose(rest.at(0.0).root, whole.at(float(whole.times[10])).root)


def test_bvh_refuses_to_skip_all():
    with pytest.raises(DataError, match=r"kneel\.bvh: it has 455 frames; a motion needs two"):
        read_bvh(BVH.path("kneel"), skip=454)


def test_unit_of_length_does_not_move_a_body_otherwise():
    human = body("average")
    centimetres, feet = (BvhConfig(name="walk_and_turn", scale=s).motion() for s in (0.01, 0.3048))
    assert np.allclose(human.moved(centimetres)(1.0), human.moved(feet)(1.0), atol=1e-9)


@pytest.mark.parametrize("up", [1, 2])
def test_axes_are_found_whichever_is_up(up):
    """A figure that stands along y and looks along z, or along z and looks along -y or x."""
    places = {"left_hip": [0.1, 0.0, 0.02], "right_hip": [-0.1, 0.0, 0.0], "head": [0.0, 0.1, 0.6]}
    ground = {joint: np.array(place) for joint, place in places.items()}
    turns = {
        1: [R_GROUND_FILE.T],
        2: [np.eye(3), vector_to_matrix(np.array([0.0, 0.0, np.pi / 2]))],
    }
    for turn in turns[up]:
        found = figure_axes({joint: turn @ place for joint, place in ground.items()})
        assert np.allclose(found @ turn, np.eye(3), atol=1e-9)


def test_animation_of_a_gltf_moves_its_own_body_as_the_file_does(reference_data):
    file, recording = RiggedBody.read(CESIUM_MAN), read_gltf(CESIUM_MAN)
    clip, human = file.clips[0], body("cesium_man")
    moved = human.moved(recording)
    for time in (0.0, 0.6, 1.3):
        expected = clip.at(time + float(clip.times[0]))
        places = joints(human, moved(time))
        for side in ("left", "right"):
            for chain in (("shoulder", "elbow", "wrist"), ("hip", "knee", "ankle")):
                for start, end in itertools.pairwise(chain):
                    bones = [
                        file.mesh.bone(recording.rig.parts[f"{side}_{joint}"])
                        for joint in (start, end)
                    ]
                    way = R_GROUND_FILE @ (expected[bones[1], :3, 3] - expected[bones[0], :3, 3])
                    limb = places[f"{side}_{end}"] - places[f"{side}_{start}"]
                    assert np.allclose(unit(limb), unit(way), atol=1e-4)


def test_gltf_answers_an_unknown_animation(reference_data):
    with pytest.raises(ConfigError, match=r"no animation 'run' \(there are: animation_0\)"):
        read_gltf(CESIUM_MAN, animation="run")


@pytest.mark.parametrize(
    "config",
    [
        *(ClipConfig(name=name) for name in CLIPS.names),
        *(BvhConfig(name=name) for name in BVH.names),
        *(KeyframesConfig(name=name) for name in KEYFRAMES.names),
    ],
    ids=lambda config: config.name,
)
def test_shipped_motion_begins_over_the_origin_and_looks_ahead(config):
    found = config.motion()
    pose = found.at(0.0)
    facing = -pose.rotations[found.rig.parts["pelvis"]][:, 1]
    assert np.allclose(pose.root[:2], 0.0, atol=1e-9)
    assert facing[0] == pytest.approx(0.0, abs=1e-9)
    assert facing[1] < 0.0


def test_motion_on_a_treadmill_stays_and_keeps_its_poses():
    recorded = ClipConfig(name="walk", ahead=False).motion()
    treadmill = Played.of(recorded, way=0.0)
    assert np.linalg.norm(recorded.velocity) > 0.5
    for cycles in (1, 5):
        gone = treadmill.at(cycles * recorded.duration).root - treadmill.at(0.0).root
        assert np.allclose(gone, 0.0, atol=1e-9)
    for joint, rotation in recorded.at(0.7).rotations.items():
        assert np.array_equal(treadmill.at(0.7).rotations[joint], rotation)


def test_motion_may_be_played_from_later_and_faster():
    recorded = motion("biovision")
    played = Played.of(recorded, start=1.0, speed=2.0)
    assert played.duration == pytest.approx((recorded.duration - 1.0) / 2.0)
    assert np.allclose(played.at(0.5).root, recorded.at(2.0).root)


@pytest.mark.parametrize("way", [0.0, 1.0])
def test_motion_that_is_over_stands_still(way):
    played = Played.of(BvhConfig(name="walk_and_turn", ahead=False).motion(), way=way)
    end = played.at(played.duration)
    assert np.allclose(played.at(played.duration + 2.0).root, end.root)


def test_motion_that_starts_after_its_end_is_refused():
    with pytest.raises(ConfigError, match=r"start is 3 s, but the motion lasts 2\.27 s"):
        BvhConfig(name="walk_and_turn", start=3.0).motion()


def test_placed_motion_goes_the_same_way_from_elsewhere():
    recorded = BvhConfig(name="walk_and_turn", ahead=False).motion()
    placed = Placed.ahead(recorded)
    first, second = ((m.at(1.5).root - m.at(0.0).root) for m in (recorded, placed))
    assert first[2] == pytest.approx(second[2])
    assert np.linalg.norm(first) == pytest.approx(np.linalg.norm(second))
