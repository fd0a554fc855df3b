"""The likelihood under nearest Gaussians, and the shapes that it compares with clouds."""

import numpy as np
import pytest

from regkit.alignment import cloud_body
from regkit.gaussians.cloud_shape import along
from regkit.geometry.rotation import vector_to_matrix
from regkit.observation import Observation
from regkit.primitives import Gaussians
from regkit.system.errors import ConfigError
from regkit_plugins.kernels.likelihood import Likelihood
from regkit_plugins.kernels.local_likelihood.local_likelihood import LocalLikelihood
from regkit_plugins.shapes.cloud_gsog import CloudGeneralizedSumOfGaussians
from regkit_plugins.shapes.cloud_sog import CloudSumOfGaussians


@pytest.fixture
def placed(random):
    count = 20
    return Gaussians(
        segments=np.zeros(count, dtype=np.intp),
        centres=random.normal(size=(count, 3)),
        axes=vector_to_matrix(random.normal(size=(count, 3))),
        scales=random.uniform(0.2, 1.0, size=(count, 3)),
        weights=random.uniform(0.5, 1.0, size=count),
    ).place(np.eye(4)[None])


@pytest.fixture
def data(random):
    count = 60
    directions = random.normal(size=(count, 3))
    directions /= np.linalg.norm(directions, axis=1, keepdims=True)
    return Observation(
        points=random.normal(size=(count, 3)),
        weights=random.uniform(0.5, 1.0, size=count),
        variances=random.uniform(0.1, 0.3, size=count),
        normals=directions,
    )


def test_all_neighbours_make_it_the_likelihood(random, data):
    """Where both are defined: equal round Gaussians and data that are round."""
    count = 15
    primitives = Gaussians(
        np.zeros(count, dtype=np.intp),
        random.normal(size=(count, 3)),
        np.tile(np.eye(3), (count, 1, 1)),
        np.full((count, 3), 0.4),
        np.ones(count),
    )
    placed = primitives.place(np.eye(4)[None])
    local = LocalLikelihood(neighbours=count, outliers=0.2, flatness=1.0).bind(data, placed)
    whole = Likelihood(outliers=0.2).bind(data, placed)
    assert local(placed).energy == pytest.approx(whole(placed).energy)
    # Pairs with less than a millionth of a point are left out.
    np.testing.assert_allclose(local(placed).wrenches, whole(placed).wrenches, atol=1e-5)
    np.testing.assert_allclose(local.inlier_probability(placed), whole.inlier_probability(placed))


def test_far_outliers_are_not_explained(lump):
    shape = CloudGeneralizedSumOfGaussians(width=0.02)
    placed = shape.bind(cloud_body("lump", lump)).place(np.eye(4)[None])
    points = np.concatenate([lump[:100], lump[:100] + 5.0])
    data = Observation(points, np.ones(200), np.full(200, 1e-4))
    explained = LocalLikelihood().bind(data, placed).inlier_probability(placed)
    assert explained[:100].min() > 0.9
    assert explained[100:].max() < 1e-6


def test_axes_are_rotations_whose_third_is_the_normal(random):
    directions = random.normal(size=(50, 3))
    directions /= np.linalg.norm(directions, axis=1, keepdims=True)
    directions[0] = [0.0, 0.0, -1.0]
    axes = along(directions)
    np.testing.assert_allclose(np.swapaxes(axes, 1, 2) @ axes, np.tile(np.eye(3), (50, 1, 1)),
                               atol=1e-12)  # fmt: skip
    np.testing.assert_allclose(np.linalg.det(axes), 1.0)
    np.testing.assert_array_equal(axes[:, :, 2], directions)


def test_flat_gaussians_lie_in_the_surface(random):
    points = random.normal(size=(200, 3)) * [1.0, 1.0, 0.0]
    made = CloudGeneralizedSumOfGaussians(width=0.5, flatness=0.1).bind(cloud_body("p", points))
    covariances = made.place(np.eye(4)[None]).covariances()
    np.testing.assert_allclose(covariances, np.tile(np.diag([0.25, 0.25, 0.0025]), (200, 1, 1)))
    round_ones = CloudSumOfGaussians(width=0.5).bind(cloud_body("p", points))
    np.testing.assert_array_equal(round_ones.scales, 0.5)


def test_body_without_a_surface_is_refused(linkage):
    with pytest.raises(ConfigError, match=r"shape 'cloud_sog'.*'linkage' has none"):
        CloudSumOfGaussians().bind(linkage)
