"""Samples: the data lie on the true surface, the body is whole in the image, a seed is a seed."""

from __future__ import annotations

import pickle
from dataclasses import replace

import numpy as np
import pytest

from regkit.sensors import CAMERAS
from regkit.system.errors import ConfigError
from regkit.testing.samples import lump
from regkit.tuning import Sampler, Views
from regkit.tuning.samples.surface import rendered_surface
from regkit_plugins.preprocessors.points import PointsPreprocessor
from regkit_plugins.templates.human import Human

POINTS = PointsPreprocessor(sigma=0.01)
COUNT = 5


def same(one, other):
    return all(
        np.array_equal(a.points, b.points)
        for a, b in zip(one.observations, other.observations, strict=True)
    ) and np.array_equal(one.markers, other.markers)


@pytest.fixture(scope="module")
def sampler(body):
    return Sampler(body, POINTS, frames=3, seed=4)


@pytest.fixture(scope="module")
def samples(sampler):
    return [sampler.sample(index) for index in range(COUNT)]


def test_sample_is_that_of_its_seed_and_index(sampler, samples):
    again = pickle.loads(pickle.dumps(sampler))
    assert same(again.sample(2), samples[2])
    assert not same(samples[1], samples[2])
    assert not same(replace(sampler, seed=5).sample(2), samples[2])


def test_data_lie_on_the_true_surface(body):
    bare = replace(body, surface=None)
    sample = Sampler(bare, POINTS, camera="sr305", noise=0.0, frames=2).sample(0)
    for observation, pose in zip(sample.observations, sample.poses, strict=True):
        capsules = bare.capsules.place(bare.place(pose).transforms)
        distances = capsules.surface_distance(observation.points)
        # Depths are rounded to 0.1 mm; between its vertices the mesh is within the capsules.
        assert distances.max() < 1e-3
        assert distances.min() > -0.1 * bare.capsules.radii.max()
        assert np.median(np.abs(distances)) < 2e-3 * body.size


def test_noise_is_that_of_the_camera(human):
    bare = replace(human, surface=None)
    exact, noisy = (
        Sampler(bare, POINTS, noise=noise, frames=1).sample(0).observations[0].depth
        for noise in (0.0, 0.02)
    )
    both = (exact > 0.0) & (noisy > 0.0)
    assert (noisy - exact)[both].std() == pytest.approx(0.02, rel=0.1)
    assert not np.array_equal(exact, noisy)


def test_depths_are_whole_units(samples):
    for sample in samples:
        units = sample.observations[0].depth * 1000.0
        assert np.allclose(units, np.rint(units), atol=1e-6)


def test_body_is_wholly_in_the_image_and_fills_it(body, samples):
    camera, surface = CAMERAS["sr4000"].camera(), rendered_surface(body)
    size = np.array([camera.width, camera.height])
    for sample in samples:
        placed = [surface.place(body.place(pose).transforms) for pose in sample.poses]
        pixels = np.array([camera.projected(vertices) for vertices in placed])
        assert np.min(placed, axis=(0, 1))[2] >= 0.74 * body.size
        assert pixels.min() > 0.0
        assert (pixels.max(axis=(0, 1)) < size - 1).all()
        filled = ((pixels.max(axis=1) - pixels.min(axis=1)) / size).max(axis=1)
        near = np.min(placed, axis=(0, 1))[2] < 0.76 * body.size
        assert near or filled.min() > 0.54
        assert filled.max() < 0.96


def test_markers_are_those_of_the_true_poses(body, samples):
    sample = samples[0]
    rows = [body.markers.names.index(name) for name in sample.names]
    for pose, markers in zip(sample.poses, sample.markers, strict=True):
        expected = body.markers.place(body.place(pose).transforms)[rows]
        assert np.allclose(markers, expected, atol=1e-9)


def test_upright_body_is_mostly_seen_upright_and_from_the_front(human):
    camera, random = CAMERAS["sr4000"].camera(), np.random.default_rng(0)
    points = human.capsules.place(human.place(human.skeleton.rest()).transforms).ends
    points = points.reshape(1, -1, 3)
    views = np.array([Views().sampled(random, camera, points, human) for _ in range(200)])
    assert views[:, 1, 1].max() < -0.8
    assert 0.55 < (views[:, 2, 2] < -0.5).mean() < 0.85
    assert (views[:, 2, 2] > 0.5).any()


def test_hand_is_seen_from_everywhere_but_from_the_forearm(hand):
    camera, random = CAMERAS["sr4000"].camera(), np.random.default_rng(0)
    points = hand.capsules.place(hand.place(hand.skeleton.rest()).transforms).ends
    points, opening = points.reshape(1, -1, 3), np.array([0.0, -1.0, 0.0])
    views = np.array([Views().sampled(random, camera, points, hand, opening) for _ in range(200)])
    towards = -views[:, 2, :3]
    assert towards[:, 1].min() >= -0.5
    for axis, sign in ((0, 1.0), (0, -1.0), (1, 1.0), (2, 1.0), (2, -1.0)):
        assert (sign * towards[:, axis] > 0.7).any()


def test_another_body_has_the_same_joint_angles(human):
    tall = Human().body(1.95)
    sampler = Sampler(human, POINTS, rendered=tall, frames=2)
    own, other = Sampler(human, POINTS, frames=2).sample(3), sampler.sample(3)
    for pose, start in zip(other.poses, other.starts, strict=True):
        assert np.allclose(pose.hinges, start.hinges)
        assert np.allclose(pose.balls, start.balls)
        assert np.array_equal(pose.root, start.root)
    assert np.allclose(own.starts[0].hinges, other.starts[0].hinges)
    arms = [
        np.linalg.norm(sample.markers[0][sample.names.index("left_elbow")]
                       - sample.markers[0][sample.names.index("left_shoulder")])
        for sample in (own, other)
    ]  # fmt: skip
    assert arms[1] / arms[0] == pytest.approx(1.95 / 1.75)


def test_body_with_other_joints_is_refused(human, hand):
    with pytest.raises(ConfigError, match=r"segment.*joint by joint"):
        Sampler(human, POINTS, rendered=hand)


def test_hinge_with_another_axis_is_refused(human):
    bones = human.skeleton
    turned = replace(bones, hinge_twists=bones.hinge_twists[:, [0, 1, 2, 4, 5, 3]])
    with pytest.raises(ConfigError, match=r"hinge.*turns about"):
        Sampler(human, POINTS, rendered=replace(human, skeleton=turned))


def test_body_without_a_common_marker_is_refused(human):
    names = tuple(f"other_{name}" for name in human.markers.names)
    markers = replace(human.markers, names=names)
    with pytest.raises(ConfigError, match="no marker"):
        Sampler(human, POINTS, rendered=replace(human, markers=markers))


def test_body_without_capsules_is_refused():
    with pytest.raises(ConfigError, match="'lump' has no capsules"):
        Sampler(lump(), POINTS)


def test_place_of_the_camera_is_found_where_corrections_swing(kite_template):
    sampler = Sampler(kite_template.body(0.6), POINTS, frames=2, seed=3141116543)
    assert len(sampler.frame(51).points)
