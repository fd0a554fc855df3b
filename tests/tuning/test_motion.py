"""Random motion stays within the limits and the speed, and does not intersect itself."""

from __future__ import annotations

import numpy as np
import pytest

from regkit.body import BodyDescription
from regkit.geometry.rigid import rigid
from regkit.geometry.rotation import vector_to_matrix
from regkit.skeleton import Pose
from regkit.system.errors import ConfigError
from regkit.tuning.samples.motion import Movement
from regkit.tuning.samples.overlap import SelfOverlap

FASTEST = 0.07


@pytest.fixture(scope="module")
def motions(body):
    movement, random = Movement(body, FASTEST), np.random.default_rng(0)
    return [movement.sampled(random, 6) for _ in range(12)]


def ends_of(body, poses):
    placed = [body.capsules.place(body.place(pose).transforms).ends for pose in poses]
    return np.array(placed).reshape(len(poses), -1, 3)


def speeds(body, poses):
    """The displacement of each end between frames, in sizes of the body."""
    return np.linalg.norm(np.diff(ends_of(body, poses), axis=0), axis=-1) / body.size


def test_motion_stays_within_the_limits(body, motions):
    limits = body.skeleton.limits
    for poses in motions:
        assert max(limits.violation(pose).max(initial=0.0) for pose in poses) < 1e-6


def test_motion_does_not_intersect_itself(body, motions):
    overlap = SelfOverlap.of(body)
    for poses in motions:
        assert overlap.allowed(np.array([body.place(pose).transforms for pose in poses])).all()


def test_no_part_is_faster_than_asked_for(body, motions):
    greatest = np.array([speeds(body, poses).max() for poses in motions])
    assert greatest.max() <= FASTEST * (1.0 + 1e-9)
    assert greatest.max() > 0.5 * FASTEST


def test_some_parts_are_slow_and_some_fast(body, motions):
    each = np.array([speeds(body, poses).max(axis=0) for poses in motions])
    assert np.quantile(each, 0.1) < 0.5 * np.quantile(each, 0.9)


def test_motion_is_smooth_over_a_second(body):
    poses = Movement(body, FASTEST).sampled(np.random.default_rng(1), 30)
    steps = np.diff(ends_of(body, poses), axis=0) / body.size
    assert np.linalg.norm(np.diff(steps, axis=0), axis=-1).max() < 0.5 * FASTEST


def test_motion_stays_near_the_origin_and_upright(human):
    movement, random = Movement(human), np.random.default_rng(2)
    roots = np.array([movement.sampled(random, 1)[0].root for _ in range(40)])
    assert np.abs(roots[:, :3, 3]).max() < human.size
    assert np.median(roots[:, 1, 1]) > 0.97


def test_motions_differ(body, motions):
    starts = [np.concatenate([poses[0].balls.ravel(), poses[0].hinges]) for poses in motions]
    assert len(np.unique(np.round(starts, 6), axis=0)) == len(motions)


def test_body_at_rest_or_in_a_stance_does_not_intersect_itself(body):
    poses = [body.skeleton.rest(), *(stance.pose for stance in body.stances)]
    transforms = np.array([body.place(pose).transforms for pose in poses])
    assert SelfOverlap.of(body).allowed(transforms).all()


def test_a_hand_through_the_trunk_is_not_allowed(human):
    bones = human.skeleton
    pose, balls = bones.rest(), bones.rest().balls.copy()
    arm = bones.ball_names.index("left_upper_arm")
    # The arm hangs down to the left, and goes through the body towards the right.
    balls[arm] = [0.0, 0.0, np.sin(np.radians(-35.0)), np.cos(np.radians(-35.0))]
    transforms = human.place(Pose(pose.root, balls, pose.hinges)).transforms
    assert not SelfOverlap.of(human).allowed(transforms[None])[0]


def test_overlap_does_not_depend_on_the_place(body):
    pose = body.stances[-1].pose if body.stances else body.skeleton.rest()
    T = rigid(vector_to_matrix(np.array([0.3, -1.0, 2.0])), np.array([3.0, 1.0, -2.0]))
    overlap, transforms = SelfOverlap.of(body), body.place(pose).transforms
    one, other = overlap.depths(np.array([transforms, T @ transforms]))
    assert np.allclose(one, other, atol=1e-9)


def test_a_body_that_always_intersects_itself_is_told():
    rod = {"start": [0, 0, 0], "end": [0, 1, 0], "radius": 0.1}

    def hinged(parent, limits):
        joint = {"type": "hinge", "axis": "x", "limits_deg": limits}
        return {"parent": parent, "offset": [0, 1, 0], "joint": joint, "capsules": [rod]}

    # The second rod lies beside the first one, and the third goes back through it.
    segments = {
        "first": {"joint": {"type": "free"}, "capsules": [rod]},
        "second": hinged("first", [179, 180]),
        "third": hinged("second", [-180, -179]),
    }
    size = {"name": "length", "value": 1.0, "range": [1.0, 1.0]}
    folded = BodyDescription.model_validate(
        {"title": "Folded.", "size": size, "segments": segments}
    )
    with pytest.raises(ConfigError, match="'folded' intersects itself"):
        Movement(folded.body("folded", 1.0)).sampled(np.random.default_rng(0), 2)
