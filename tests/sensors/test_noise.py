"""The noise of depth cameras: each part against its formula on a plane, and what a seed does."""

from __future__ import annotations

import numpy as np
import pytest

from regkit.sensors.cameras import CAMERAS
from regkit.sensors.noise import NOISES, DepthNoise, noise_of
from regkit.sensors.noise.edges import step_across
from regkit.sensors.noise.model import quantised
from regkit.sensors.noise.parts import (
    AxialNoise,
    FlyingPixels,
    LateralNoise,
    MissingPixels,
)
from regkit.sensors.raycast import View, stored

SHAPE = (240, 320)


def wall(depth=2.0, angle_deg=0.0):
    """A plane of one depth that is seen everywhere at one angle."""
    return View(np.full(SHAPE, depth), np.full(SHAPE, np.cos(np.radians(angle_deg))))


def two_walls(near=2.0, far=2.5):
    depth = np.full(SHAPE, near)
    depth[:, 160:] = far
    return View(depth, np.ones(SHAPE))


def errors(noise, view, seed=0):
    return noise.applied(view, np.random.default_rng(seed)) - view.depth


@pytest.mark.parametrize("depth", [1.0, 2.0, 3.5])
@pytest.mark.parametrize("angle_deg", [0.0, 45.0, 70.0])
def test_axial_noise_has_the_deviation_of_its_formula(depth, angle_deg):
    axial = AxialNoise(constant=0.0012, quadratic=0.0019, nearest=0.4, shading=1.0, oblique=0.0001)
    angle = np.radians(angle_deg)
    expected = (0.0012 + 0.0019 * (depth - 0.4) ** 2) / np.cos(angle)
    expected += 0.0001 / np.sqrt(depth) * (angle / (np.pi / 2 - angle)) ** 2
    found = errors(DepthNoise(axial=axial), wall(depth, angle_deg))
    assert found.std() == pytest.approx(expected, rel=0.01)
    assert found.mean() == pytest.approx(0.0, abs=4.0 * expected / np.sqrt(found.size))


def test_kinect_has_the_noise_that_nguyen_measured():
    """0.0012 + 0.0019 (z - 0.4)^2 [m] before a wall."""
    sigma = NOISES["kinect_v1"].axial.sigma(np.array([1.4, 2.9]), np.ones(2))
    assert np.allclose(sigma, [0.0031, 0.0131], atol=1e-4)


def test_time_of_flight_has_four_millimetres_at_two_metres():
    sigma = NOISES["sr4000"].axial.sigma(np.array([2.0, 4.0]), np.ones(2))
    assert np.allclose(sigma, [0.004, 0.016])


def test_lateral_noise_makes_a_slope_rough_by_its_rise():
    slope = 0.01
    depth = 2.0 + slope * np.arange(SHAPE[1]) * np.ones(SHAPE)
    noise = DepthNoise(lateral=LateralNoise(constant_px=2.0))
    found = errors(noise, View(depth, np.ones(SHAPE)))[:, 20:-20]
    # A displacement that is rounded has the variance of the rounding beside its own.
    assert found.std() == pytest.approx(slope * np.sqrt(4.0 + 1.0 / 12.0), rel=0.02)
    steps = found / slope
    assert np.allclose(steps, np.rint(steps), atol=1e-6)


def test_lateral_noise_leaves_a_wall_alone_and_frays_an_outline():
    noise = DepthNoise(lateral=LateralNoise(constant_px=0.8, oblique_px=0.035))
    assert not errors(noise, wall()).any()
    found = errors(noise, two_walls())
    assert np.abs(found[:, 155:165]).max() == pytest.approx(0.5)
    assert not found[:, :150].any()
    assert not found[:, 170:].any()


def test_lateral_noise_grows_with_the_angle_of_incidence():
    lateral = LateralNoise(constant_px=0.8, oblique_px=0.035)
    angle = np.radians(75.0)
    expected = 0.8 + 0.035 * angle / (np.pi / 2 - angle)
    assert lateral.sigma(np.cos(angle)) == pytest.approx(expected)


def test_flying_pixels_lie_between_the_surfaces_beside_an_edge():
    found = errors(DepthNoise(flying=FlyingPixels(share=0.5, reach=1.0)), two_walls())
    beside = np.zeros(SHAPE, dtype=bool)
    beside[:, 159:161] = True
    assert not found[~beside].any()
    near, far = found[:, 159], found[:, 160]
    assert near.min() >= 0.0
    assert near.max() <= 0.5
    assert far.max() <= 0.0
    flying = near[near > 0.0]
    assert len(flying) / len(near) == pytest.approx(0.5, abs=0.1)
    assert flying.mean() == pytest.approx(0.25, abs=0.05)


def test_flying_pixels_at_an_outline_go_as_far_as_they_reach():
    view = two_walls(far=0.0)
    measured = DepthNoise(flying=FlyingPixels(share=1.0, reach=0.2)).applied(
        view, np.random.default_rng(0)
    )
    assert not measured[:, 160:].any()
    beyond = measured[:, 159] - 2.0
    assert (beyond > 0.0).all()
    assert beyond.max() == pytest.approx(0.2, abs=0.01)


def test_quantised_depths_have_the_steps_of_the_disparity():
    """An eighth of a pixel over 585 px and 7.5 cm is 2.85 mm at 1 m, and grows with the square."""
    for depth in (1.0, 2.0, 4.0):
        near = depth + np.linspace(-0.02, 0.02, 20001)
        levels = np.unique(quantised(near, 0.00285))
        assert np.diff(levels).mean() == pytest.approx(0.00285 * depth**2, rel=0.02)
        assert np.abs(quantised(near, 0.00285) - near).max() <= 0.00285 * depth**2 * 0.53


def test_quantised_leaves_gaps_and_loses_what_is_too_far():
    assert quantised(np.array([0.0, 1.0, 1e6]), 0.01).tolist() == [0.0, 1.0, 0.0]


@pytest.mark.parametrize("share", [0.0, 0.1, 1.0])
def test_missing_pixels_are_as_many_as_asked_for(share):
    measured = DepthNoise(missing=MissingPixels(share=share)).applied(
        wall(), np.random.default_rng(0)
    )
    assert (measured == 0.0).mean() == pytest.approx(share, abs=0.005)


def test_missing_pixels_are_beside_edges_and_at_grazing_incidence():
    random = np.random.default_rng(0)
    edges = MissingPixels(edge_share=1.0).missing(two_walls(), random)
    assert np.flatnonzero(edges.any(axis=0)).tolist() == [159, 160]
    assert MissingPixels(grazing_deg=80.0).missing(wall(angle_deg=81.0), random).all()
    assert not MissingPixels(grazing_deg=80.0).missing(wall(angle_deg=79.0), random).any()


def test_step_across_is_that_to_the_most_different_neighbour():
    depth = np.array([[2.0, 2.1, 0.0], [2.0, 2.1, 2.4]])
    expected = [[0.1, np.inf, 0.0], [0.1, 0.3, np.inf]]
    assert np.allclose(step_across(depth), expected)


def test_no_noise_gives_the_exact_depth():
    view = two_walls(far=0.0)
    for choice in ("none", 0.0, DepthNoise()):
        assert np.array_equal(noise_of(choice).applied(view, np.random.default_rng(0)), view.depth)


def test_a_number_is_plain_gaussian_noise():
    for depth in (0.5, 4.0):
        found = errors(noise_of(0.008), wall(depth, 60.0))
        assert found.std() == pytest.approx(0.008, rel=0.01)


@pytest.mark.parametrize("name", CAMERAS)
def test_same_seed_gives_the_same_image_and_another_one_other_noise(name):
    view = two_walls(far=0.0)
    first, again, other = (
        NOISES[name].applied(view, np.random.default_rng(seed)) for seed in (1, 1, 2)
    )
    assert np.array_equal(first, again)
    assert (first != other).mean() > 0.1
    assert np.median(np.abs(first[:, :150] - other[:, :150])) < 0.1


def test_a_part_does_the_same_without_the_others():
    axial = AxialNoise(constant=0.01)
    alone = errors(DepthNoise(axial=axial), wall())
    missing = MissingPixels(share=0.3)
    both = DepthNoise(axial=axial, missing=missing).applied(wall(), np.random.default_rng(0))
    assert np.array_equal(both[both > 0.0], (alone + 2.0)[both > 0.0])


def test_stored_depths_are_whole_units_and_out_of_range_is_missing():
    depth = np.array([0.0, 0.0002, 1.2344, 65.6, 70.0])
    assert stored(depth, 1000.0).tolist() == [0, 0, 1234, 0, 0]
