"""Tapered capsules that a template lists for a shape model: their moments, fit and use."""

import numpy as np
import pytest

from regkit.body import (
    BallParameters,
    Body,
    CapsuleParameters,
    GaussianParameters,
    ListedShape,
    Mirror,
)
from regkit.geometry.capsules import Capsules
from regkit.interfaces import ShapeModel
from regkit.testing.samples import linkage

CASES = {
    "cylinder": CapsuleParameters(start=(0.1, 0.0, 0.2), end=(0.3, 0.4, 0.1), radius=0.08),
    "cone": CapsuleParameters(start=(0.0, 0.05, 0.0), end=(0.0, 0.5, 0.1), radius=(0.1, 0.04)),
    "widening": CapsuleParameters(start=(0.1, 0.0, 0.0), end=(0.4, 0.1, 0.0), radius=(0.03, 0.06)),
    "sphere": CapsuleParameters(start=(0.1, 0.2, 0.3), end=(0.1, 0.2, 0.3), radius=0.1),
    "contained": CapsuleParameters(start=(0.1, 0.2, 0.3), end=(0.1, 0.22, 0.3), radius=(0.1, 0.02)),
}


def inside(one: CapsuleParameters, random: np.random.Generator) -> np.ndarray:
    """Returns points that fill a capsule evenly, (N, 3) [m]."""
    ends, radii = np.array([one.start, one.end]), np.broadcast_to(one.radius, 2)
    low, high = (ends - radii[:, None]).min(axis=0), (ends + radii[:, None]).max(axis=0)
    points = random.uniform(low, high, size=(200_000, 3))
    capsule = Capsules(np.zeros(1, dtype=np.intp), ends[None], radii[None].copy())
    return points[capsule.surface_distance(points) < 0.0]


@pytest.mark.parametrize("name", CASES)
def test_moments_are_those_of_points_inside(name, random):
    mean, covariance = CASES[name].moments()
    points = inside(CASES[name], random)
    np.testing.assert_allclose(mean, points.mean(axis=0), atol=2e-3)
    np.testing.assert_allclose(covariance, np.cov(points.T), atol=0.03 * np.trace(covariance))


@pytest.mark.parametrize("name", ["cylinder", "cone", "widening"])
def test_points_inside_a_capsule_give_the_capsule(name, random):
    one = CASES[name]
    found = CapsuleParameters.fitted(inside(one, random))
    np.testing.assert_allclose(found.start, one.start, atol=0.015)
    np.testing.assert_allclose(found.end, one.end, atol=0.015)
    np.testing.assert_allclose(found.radius, np.broadcast_to(one.radius, 2), atol=0.015)


@pytest.mark.parametrize("name", ["sphere", "contained"])
def test_points_inside_a_sphere_give_about_the_sphere(name, random):
    found = CapsuleParameters.fitted(inside(CASES[name], random))
    assert np.linalg.norm(np.subtract(found.end, found.start)) < 0.04
    np.testing.assert_allclose(found.radius, 0.1, atol=0.015)


def test_fitted_capsule_has_the_radii_and_the_direction_of_its_like(random):
    points = inside(CASES["cylinder"], random)
    like = CapsuleParameters(start=(0.0, 1.0, 0.0), end=(0.0, 0.0, 0.0), radius=0.2)
    found = CapsuleParameters.fitted(points, like)
    assert isinstance(found.radius, float)
    np.testing.assert_allclose(found.start, CASES["cylinder"].end, atol=0.015)


def test_flat_points_give_a_sphere_and_those_of_a_cone_no_capsule_within_a_sphere(random):
    disc = random.normal(size=(1000, 3)) * [0.1, 0.1, 0.001]
    flat = CapsuleParameters.fitted(disc)
    assert flat.radius[0] > 0.05
    heights = 0.5 * random.uniform(size=5000) ** (1 / 3)
    angles, parts = random.uniform(0, 2 * np.pi, 5000), np.sqrt(random.uniform(size=5000))
    radii = 0.2 * heights * parts
    cone = np.column_stack([radii * np.cos(angles), heights, radii * np.sin(angles)])
    found = CapsuleParameters.fitted(cone)
    length = np.linalg.norm(np.subtract(found.end, found.start))
    assert 0.0 < found.radius[1] - found.radius[0] < length


@pytest.mark.parametrize("name", CASES)
def test_primitive_of_a_capsule_is_the_capsule_or_has_its_moments(name):
    one = CASES[name]
    ends, radii = np.array([one.start, one.end]), np.broadcast_to(one.radius, 2)
    assert CapsuleParameters.of_capsule(ends, radii) == one
    mean, covariance = one.moments()
    solid, ball = (made.of_capsule(ends, radii) for made in (GaussianParameters, BallParameters))
    np.testing.assert_allclose(solid.moments()[0], mean, atol=1e-12)
    np.testing.assert_allclose(solid.moments()[1], covariance, atol=1e-12)
    np.testing.assert_allclose(ball.moments()[0], mean, atol=1e-12)
    np.testing.assert_allclose(3.0 * ball.sigma**2, np.trace(covariance))


@pytest.mark.parametrize("name", CASES)
def test_mirror_image_of_a_capsule_has_the_mirrored_parameters(name):
    one = CASES[name]
    ends, radii = np.array([one.start, one.end]), np.broadcast_to(one.radius, 2)
    for made in (GaussianParameters, BallParameters, CapsuleParameters):
        image = made.of_capsule(ends * [-1.0, 1.0, 1.0], radii)
        expected = made.of_capsule(ends, radii).deformed(Mirror())
        for field, value in expected.model_dump().items():
            np.testing.assert_allclose(getattr(image, field), value, atol=1e-12)


def test_sphere_mesh_takes_the_capsules_that_are_listed():
    body = linkage()
    own = ShapeModel.load("sphere")()
    ends, radii = body.capsules.ends, body.capsules.radii
    rows = tuple(
        CapsuleParameters(start=tuple(start), end=tuple(end), radius=tuple(radius))
        for (start, end), radius in zip(ends.tolist(), (0.5 * radii).tolist(), strict=True)
    )
    listed = ListedShape(body.capsules.segments, rows)
    thin = Body(**{**vars(body), "shapes": {"sphere": listed, "sphere/none": ListedShape(
        np.zeros(0, dtype=np.intp), ())}})  # fmt: skip
    one, other = own.bind(body), own.bind(thin)
    np.testing.assert_allclose(other.centres, one.centres, atol=1e-12)
    np.testing.assert_allclose(other.radii, 0.5 * one.radii)
    assert len(ShapeModel.load("sphere")(tuned="none").bind(thin)) == 0
