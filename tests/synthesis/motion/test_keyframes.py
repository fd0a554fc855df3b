"""Keyframes are reached, and between them a figure moves smoothly and on its feet."""

from __future__ import annotations

import numpy as np
import pytest
from motion_cases import body, joints
from pydantic import ValidationError

from regkit_synthesis.motion.config import KeyframesConfig
from regkit_synthesis.motion.keyframes import Keyframe, Keyframes
from regkit_synthesis.motion.shipped import KEYFRAMES

FAST = ("front_kicks", "tennis")
"""A foot and a hand that are thrown go at nearly 6 m/s."""


def _motion(*frames, loops=False):
    return Keyframes(frames=tuple(Keyframe(**frame) for frame in frames), loops=loops).motion()


def _bend(pose):
    """How far the left elbow is bent [deg]."""
    relative = pose.rotations["left_shoulder"].T @ pose.rotations["left_elbow"]
    return -np.degrees(np.arctan2(relative[2, 1], relative[1, 1]))


def test_keyframes_are_reached_and_not_passed():
    bent = _motion(
        {"time": 0.0, "joints": {"left_elbow": (0, 0, 0)}},
        {"time": 1.0, "joints": {"left_elbow": (-80, 0, 0)}},
        {"time": 1.5, "joints": {"left_elbow": (-80, 0, 0)}},
        {"time": 2.5, "joints": {"left_elbow": (-10, 0, 0)}},
    )
    for time, angle in ((0.0, 0.0), (1.0, 80.0), (1.25, 80.0), (1.5, 80.0), (2.5, 10.0)):
        assert _bend(bent.at(time)) == pytest.approx(angle, abs=1e-6)
    angles = np.array([_bend(bent.at(time)) for time in np.linspace(0.0, 2.5, 101)])
    assert angles.min() > -1e-6
    assert angles.max() < 80.0 + 1e-6


def test_what_a_frame_does_not_name_goes_on():
    bent = _motion(
        {"time": 0.0, "joints": {"left_elbow": (0, 0, 0)}},
        {"time": 1.0},
        {"time": 2.0, "joints": {"left_elbow": (-80, 0, 0)}},
    )
    assert _bend(bent.at(1.0)) == pytest.approx(40.0, abs=1e-6)


def test_figure_comes_to_rest_at_its_ends():
    bent = _motion(
        {"time": 0.0, "joints": {"left_elbow": (0, 0, 0)}},
        {"time": 1.0, "joints": {"left_elbow": (-80, 0, 0)}},
    )
    for time in (0.0, 1.0):
        assert abs(_bend(bent.at(time + 1e-3)) - _bend(bent.at(time - 1e-3))) < 1e-2


def test_whole_turn_is_a_turn():
    turn = _motion(
        {"time": 0.0, "joints": {"pelvis": (0, 0, 0)}},
        {"time": 4.0, "joints": {"pelvis": (0, 0, 360)}},
        loops=True,
    )
    assert np.allclose(turn.at(2.0).rotations["pelvis"], np.diag([-1.0, -1.0, 1.0]), atol=1e-9)
    assert np.allclose(turn.at(5.0).rotations["head"], turn.at(1.0).rotations["head"], atol=1e-9)


def test_loop_steps_on():
    steps = _motion(
        {"time": 0.0, "feet": (0, 0, 0)}, {"time": 1.0, "feet": (0, -0.5, 0)}, loops=True
    )
    assert np.allclose(steps.at(2.5).root - steps.at(0.5).root, [0.0, -1.0, 0.0], atol=1e-9)


@pytest.mark.parametrize(
    ("frames", "message"),
    [
        (({"time": 0.0}, {"time": 0.0}), "the times of the frames must increase"),
        (({"time": 1.0}, {"time": 2.0}), "the first frame must have the time 0"),
        (
            (
                {"time": 0.0, "joints": {"neck": (0, 0, 0)}},
                {"time": 1.0, "joints": {"neck": (9, 0, 0)}},
            ),
            "must end as it begins; neck goes from",
        ),
        (({"time": 0.0}, {"time": 1.0, "joints": {"left_elbo": (0, 0, 0)}}), "'left_elbow'"),
    ],
)
def test_wrong_frames_are_told(frames, message):
    with pytest.raises(ValidationError, match=message):
        _motion(*frames, loops=True)


@pytest.mark.parametrize("name", KEYFRAMES.names)
def test_shipped_keyframes_move_smoothly_and_keep_a_foot_on_the_ground(name):
    human, source = body("average"), KeyframesConfig(name=name).motion()
    moved = human.moved(source)
    places = [joints(human, moved(time)) for time in np.arange(0.0, source.duration, 1.0 / 30.0)]
    track = np.array([list(place.values()) for place in places])
    steps = np.diff(track, axis=0)
    fastest, jerkiest = (0.2, 0.12) if name in FAST else (0.12, 0.035)
    assert np.linalg.norm(steps, axis=-1).max() < fastest
    assert np.linalg.norm(np.diff(steps, axis=0), axis=-1).max() < jerkiest
    ankles = [min(place["left_ankle"][2], place["right_ankle"][2]) for place in places]
    assert np.ptp(ankles) < 0.02


def test_arms_are_raised_to_their_own_sides():
    human, source = body("average"), KeyframesConfig(name="arms").motion()
    places = joints(human, human.moved(source)(1.1))
    for side, sign in (("left", 1.0), ("right", -1.0)):
        assert sign * places[f"{side}_wrist"][0] > 0.5
        assert places[f"{side}_wrist"][2] == pytest.approx(places["neck"][2], abs=0.15)


def test_squat_bends_the_knees_forward_over_soles_that_stay_level():
    human, source = body("average"), KeyframesConfig(name="squat").motion()
    for time in (0.7, 1.4):
        places, pose = joints(human, human.moved(source)(time)), source.at(time)
        for side in ("left", "right"):
            knee, ankle = places[f"{side}_knee"], places[f"{side}_ankle"]
            assert knee[1] < ankle[1] - 0.08
            # The foot does not tip; it may turn aside with the knee.
            assert pose.rotations[f"{side}_ankle"][2, 2] > 0.97
    assert places["pelvis"][2] < 0.6 * joints(human, human.moved(source)(0.0))["pelvis"][2]


def test_right_hand_waves_and_left_hand_hangs():
    human, source = body("average"), KeyframesConfig(name="wave").motion()
    places = [joints(human, human.moved(source)(time)) for time in (1.25, 1.6)]
    for place in places:
        assert place["right_wrist"][2] > place["neck"][2]
        assert place["left_wrist"][2] < place["left_elbow"][2] < place["left_shoulder"][2]
    assert np.linalg.norm(places[1]["right_wrist"] - places[0]["right_wrist"]) > 0.1


@pytest.mark.parametrize("name", KEYFRAMES.names)
def test_shipped_keyframes_keep_the_hands_out_of_the_thighs(name):
    """A thigh and a hand touch where their bones are some 11 cm from each other."""
    human, source = body("average"), KeyframesConfig(name=name).motion()
    moved = human.moved(source)
    for time in np.linspace(0.0, source.duration, 40):
        places = joints(human, moved(time))
        for side in ("left", "right"):
            hip, way = places[f"{side}_hip"], places[f"{side}_knee"] - places[f"{side}_hip"]
            for joint in ("wrist", "hand"):
                share = np.clip((places[f"{side}_{joint}"] - hip) @ way / (way @ way), 0.0, 1.0)
                assert np.linalg.norm(places[f"{side}_{joint}"] - hip - share * way) > 0.12
