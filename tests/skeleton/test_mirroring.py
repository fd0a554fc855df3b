"""Mirrored poses of skeletons with two sides."""

import numpy as np
import pytest
from scipy.spatial import KDTree

from regkit.geometry.rigid import rigid
from regkit.geometry.rotation import vector_to_matrix
from regkit.search.exemplars.poses import sampled_poses
from regkit.skeleton import Mirroring, Pose
from regkit_plugins.templates.hand import Hand
from regkit_plugins.templates.human import Human

BODY = Human(height=1.7).body(1.7)
ROOT = rigid(vector_to_matrix(np.array([0.4, -0.7, 1.1])), np.array([0.1, 0.2, 3.0]))
PLANE, THROUGH = np.array([0.6, 0.0, 0.8]), np.array([0.3, -0.1, 2.5])


@pytest.fixture
def poses(random) -> list[Pose]:
    balls, hinges = sampled_poses(BODY, random, 4)
    return [Pose(ROOT, *joints) for joints in zip(balls, hinges, strict=True)]


def ends(pose: Pose) -> np.ndarray:
    return BODY.capsules.place(BODY.place(pose).transforms).ends.reshape(-1, 3)


def test_mirrored_body_is_the_mirror_image(poses):
    mirroring = Mirroring.of(BODY.skeleton)
    reflection = np.eye(3) - 2.0 * np.outer(PLANE, PLANE)
    for pose in poses:
        mirrored = mirroring.mirrored(pose, PLANE, THROUGH)
        image = THROUGH + (ends(pose) - THROUGH) @ reflection
        assert KDTree(ends(mirrored)).query(image)[0].max() < 1e-9
        assert np.linalg.det(mirrored.root[:3, :3]) == pytest.approx(1.0)


def test_mirrored_pose_exchanges_left_and_right(poses):
    mirrored = Mirroring.of(BODY.skeleton).mirrored(poses[0], PLANE, THROUGH)
    names = list(BODY.skeleton.names)
    hands = [names.index(f"{side}_hand") for side in ("left", "right")]
    before = BODY.place(poses[0]).transforms[hands, :3, 3]
    after = BODY.place(mirrored).transforms[hands[::-1], :3, 3]
    reflection = np.eye(3) - 2.0 * np.outer(PLANE, PLANE)
    np.testing.assert_allclose(after, THROUGH + (before - THROUGH) @ reflection, atol=1e-9)


def test_mirrored_pose_keeps_the_limits(poses):
    mirroring = Mirroring.of(BODY.skeleton)
    for pose in poses:
        assert BODY.skeleton.limits.violation(mirroring.mirrored(pose, PLANE, THROUGH)).max() < 1e-6


def test_mirroring_twice_changes_nothing(poses):
    mirroring = Mirroring.of(BODY.skeleton)
    once = mirroring.mirrored(poses[1], PLANE, THROUGH)
    twice = mirroring.mirrored(once, PLANE, THROUGH)
    np.testing.assert_allclose(ends(twice), ends(poses[1]), atol=1e-9)


def test_hand_has_no_other_side():
    assert Mirroring.of(Hand(length=0.18).body(0.18).skeleton) is None


def test_sides_of_many_poses_are_those_of_each(random):
    mirroring = Mirroring.of(BODY.skeleton)
    balls, hinges = sampled_poses(BODY, random, 7)
    of_balls, of_hinges = mirroring.sides(balls, hinges)
    for index in range(7):
        pose = mirroring.mirrored(Pose(ROOT, balls[index], hinges[index]), PLANE, THROUGH)
        np.testing.assert_array_equal(of_balls[index], pose.balls)
        np.testing.assert_array_equal(of_hinges[index], pose.hinges)


def test_half_of_the_legs_are_mirror_images_if_that_is_asked_for(random):
    names, places = BODY.markers.names, []
    for joints in zip(*sampled_poses(BODY, random, 200, symmetric=0.5), strict=True):
        transforms = BODY.place(Pose(np.eye(4), *joints)).transforms
        placed = dict(zip(names, BODY.markers.place(transforms), strict=True))
        places.append([placed[f"{side}_ankle"] for side in ("left", "right")])
    left, right = np.array(places).transpose(1, 0, 2)
    alike = np.linalg.norm(left * [-1.0, 1.0, 1.0] - right, axis=1) < 0.05
    assert 0.3 < alike.mean() < 0.8
