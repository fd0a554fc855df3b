"""Errors by part, and identity switches of like parts."""

from dataclasses import replace

import numpy as np
import pytest
from made_tracks import made_track

from regkit.body import Body
from regkit.interfaces import Template
from regkit.metrics import exchanged_frames, joint_errors, measured
from regkit.observation import Truth
from regkit.skeleton import Pose
from regkit.tracking import Track


@pytest.fixture(scope="module")
def hands() -> Body:
    free = {"left": {"kind": "hand", "side": "left"}, "right": {"kind": "hand"}}
    template = {"kind": "composed", "free": free}
    return Template.parse(template, place="test", field="template").body(0.19)


def track_of(body: Body, poses: list[Pose]) -> Track:
    """A track of given poses."""
    return replace(
        made_track(body, len(poses)),
        root=np.array([pose.root for pose in poses]),
        balls=np.array([pose.balls for pose in poses]),
        hinges=np.array([pose.hinges for pose in poses]),
        markers=np.array([body.markers.place(body.place(pose).transforms) for pose in poses]),
    )


def posed(body: Body, *places: list[float]) -> Pose:
    """The hands at rest at two places."""
    pose = body.skeleton.rest()
    for one, place in zip(body.free_bodies, places, strict=True):
        own = one.body.skeleton.rest()
        own.root[:3, 3] = place
        pose = one.placed(own, pose)
    return pose


HERE, THERE = [-0.2, 0.0, 0.5], [0.2, 0.0, 0.5]


def test_exchanged_hands_are_told_in_their_frames(hands) -> None:
    right, wrong = posed(hands, HERE, THERE), posed(hands, THERE, HERE)
    truth = Truth(hands.markers.names, track_of(hands, [right] * 4).markers)
    track = track_of(hands, [right, wrong, wrong, right])
    errors = joint_errors(track, hands, truth, {})
    np.testing.assert_array_equal(errors.exchanged, [0.0, 1.0, 1.0, 0.0])
    assert measured(track, hands, errors, 30.0).exchanged_percent == 50.0


def test_errors_of_a_part_are_those_of_its_joints(hands) -> None:
    right, off = posed(hands, HERE, THERE), posed(hands, HERE, [0.2, 0.01, 0.5])
    truth = Truth(hands.markers.names, track_of(hands, [right] * 2).markers)
    errors = joint_errors(track_of(hands, [right, off]), hands, truth, {})
    left, other = errors.of_part("left"), errors.of_part("right")
    assert set(left.joints) | set(other.joints) == set(hands.markers.names)
    assert left.raw.max() == 0.0
    np.testing.assert_allclose(other.raw, np.outer([0.0, 0.01], np.ones(len(other.joints))))


def test_a_body_without_parts_has_no_identities(linkage) -> None:
    track = track_of(linkage, [linkage.skeleton.rest()] * 2)
    errors = joint_errors(track, linkage, Truth(linkage.markers.names, track.markers), {})
    assert errors.parts == ()
    assert errors.exchanged is None
    assert measured(track, linkage, errors, 30.0).exchanged_percent is None


def test_unknown_joints_do_not_count(random) -> None:
    """The one joint that is known of both parts decides."""
    names, parts = ("a_tip", "a_base", "b_tip", "b_base"), ("a", "a", "b", "b")
    truth = random.normal(size=(1, 4, 3))
    places = truth[:, [2, 1, 0, 3]]
    places = places + np.array([[[0.0], [9.0], [0.0], [9.0]]])
    unknown = truth.copy()
    unknown[:, 1] = np.nan
    assert exchanged_frames(names, parts, places, unknown) == [1.0]


def test_parts_of_other_joints_are_not_alike(random) -> None:
    places = random.normal(size=(3, 2, 3))
    found = exchanged_frames(("a_tip", "b_base"), ("a", "b"), places, places)
    assert found is None


def test_the_order_of_joints_does_not_matter(hands, random) -> None:
    right, wrong = posed(hands, HERE, THERE), posed(hands, THERE, HERE)
    order = random.permutation(len(hands.markers.names))
    names = tuple(hands.markers.names[at] for at in order)
    truth = Truth(names, track_of(hands, [right] * 2).markers[:, order])
    errors = joint_errors(track_of(hands, [right, wrong]), hands, truth, {})
    np.testing.assert_array_equal(errors.exchanged, [0.0, 1.0])
    assert replace(errors, parts=()).exchanged is not None
