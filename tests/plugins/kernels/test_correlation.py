"""The correlation kernel against quadrature, finite differences and its laws."""

import numpy as np
import pytest

from regkit.geometry.rigid import rigid
from regkit.geometry.rotation import vector_to_matrix
from regkit.observation import Observation
from regkit.primitives import Gaussians
from regkit.registration import COORDINATES, RegistrationProblem
from regkit_plugins.kernels.correlation import Correlation
from regkit_plugins.shapes.gsog import GeneralizedSumOfGaussians
from regkit_plugins.shapes.sog import SumOfGaussians

SHAPES = [SumOfGaussians(), GeneralizedSumOfGaussians()]


def gaussians(count: int, random: np.random.Generator) -> Gaussians:
    return Gaussians(
        segments=np.zeros(count, dtype=np.intp),
        centres=random.normal(scale=0.2, size=(count, 3)),
        axes=vector_to_matrix(random.normal(size=(count, 3))),
        scales=random.uniform(0.04, 0.15, size=(count, 3)),
        weights=random.uniform(0.5, 2.0, size=count),
    )


def cloud(count: int, random: np.random.Generator, sigmas=(0.01, 0.02, 0.04)) -> Observation:
    return Observation(
        points=random.normal(scale=0.3, size=(count, 3)),
        weights=random.uniform(0.5, 2.0, size=count),
        variances=random.choice(sigmas, size=count) ** 2,
    )


def test_energy_is_the_integral_of_the_product(random):
    """Eq. 5, by Gauss-Hermite quadrature over the data's Gaussian, to 1e-8."""
    model = gaussians(1, random)
    placed = model.place(np.eye(4)[None])
    data = cloud(1, random, sigmas=(0.05,))
    nodes, weights = np.polynomial.hermite_e.hermegauss(40)
    grid = np.stack(np.meshgrid(nodes, nodes, nodes, indexing="ij"), axis=-1).reshape(-1, 3)
    mass = np.einsum("i,j,k->ijk", weights, weights, weights).ravel() / (2 * np.pi) ** 1.5
    offsets = data.points[0] + 0.05 * grid - placed.centres[0]
    precision = np.linalg.inv(placed.covariances()[0])
    density = model.weights[0] * np.exp(
        -0.5 * np.einsum("ni,ij,nj->n", offsets, precision, offsets)
    )
    expected = -float(mass @ density)
    found = Correlation().bind(data, placed)(placed).energy
    assert found == pytest.approx(expected, rel=1e-8)


def test_energy_is_the_pairwise_closed_form(random):
    """Eq. 8 summed over all pairs, over the integral of the data."""
    model, data = gaussians(5, random), cloud(40, random)
    placed = model.place(np.eye(4)[None])
    integral = (2 * np.pi) ** 1.5 * (data.weights @ data.variances**1.5)
    total = 0.0
    for centre, covariance, weight in zip(
        placed.centres, placed.covariances(), model.weights, strict=True
    ):
        for point, own, variance in zip(data.points, data.weights, data.variances, strict=True):
            spread = covariance + variance * np.eye(3)
            d = centre - point
            amplitude = np.sqrt(np.linalg.det(covariance) * variance**3 / np.linalg.det(spread))
            total += weight * own * (2 * np.pi) ** 1.5 * amplitude * np.exp(
                -0.5 * d @ np.linalg.solve(spread, d)
            )  # fmt: skip
    found = Correlation().bind(data, placed)(placed).energy
    assert found == pytest.approx(-total / integral, rel=1e-12)


def test_energy_does_not_depend_on_where_the_world_begins(random):
    model, data = gaussians(6, random), cloud(80, random)
    motion = rigid(vector_to_matrix(random.normal(size=3)), 50.0 * random.normal(size=3))
    placed, moved = model.place(np.eye(4)[None]), model.place(motion[None])
    there = Observation(
        data.points @ motion[:3, :3].T + motion[:3, 3], data.weights, data.variances
    )
    here = Correlation().bind(data, placed)(placed)
    elsewhere = Correlation().bind(there, moved)(moved)
    assert elsewhere.energy == pytest.approx(here.energy, rel=1e-10)
    turned = here.wrenches.reshape(-1, 2, 3) @ motion[:3, :3].T
    np.testing.assert_allclose(elsewhere.wrenches.reshape(-1, 2, 3), turned, atol=1e-9)


def test_common_motion_of_model_and_data_has_no_net_force(random):
    """Action and reaction: with the data's reaction at the data, forces and torques cancel."""
    model, data = gaussians(1, random), cloud(1, random)
    placed = model.place(np.eye(4)[None])
    wrench = Correlation().bind(data, placed)(placed).wrenches[0]
    arm = data.points[0] - placed.centres[0]
    np.testing.assert_allclose(wrench[3:], np.cross(arm, wrench[:3]), atol=1e-12)


@pytest.mark.parametrize("smoothing", [0.0, 0.03])
@pytest.mark.parametrize("name", COORDINATES)
@pytest.mark.parametrize("shape", SHAPES, ids=lambda shape: shape.kind)
def test_gradient_agrees_with_finite_differences(linkage, random, shape, name, smoothing):
    """To 1e-6 of the gradient, for a random root, away from the coordinates' origin."""
    primitives = shape.bind(linkage)
    bones = linkage.skeleton
    start = bones.retract(bones.rest(), 0.7 * random.normal(size=bones.dofs))
    placed = primitives.place(linkage.place(start).transforms)
    data = cloud(300, random)
    data = Observation(data.points + start.root[:3, 3], data.weights, data.variances)
    coordinates = COORDINATES[name](bones, start)
    problem = RegistrationProblem(
        coordinates,
        primitives,
        {"kernel": Correlation().bind(data, placed, smoothing=smoothing)},
    )
    x = problem.start + 0.3 * random.normal(size=len(problem.start))
    _, gradient = problem.value_and_gradient(x)
    step = 1e-6
    differences = [
        problem.value_and_gradient(x + step * e)[0] - problem.value_and_gradient(x - step * e)[0]
        for e in np.eye(len(x))
    ]
    numerical = np.array(differences) / (2 * step)
    assert np.abs(gradient).max() > 1e-4
    np.testing.assert_allclose(gradient, numerical, atol=1e-6 * np.abs(gradient).max())


def test_frozen_covariance_keeps_its_start_orientation(random):
    """Turned about their centres, frozen Gaussians do not change; exact ones do."""
    model, data = gaussians(4, random), cloud(100, random)
    start = model.place(np.eye(4)[None])
    turned = Gaussians(
        model.segments,
        model.centres,
        vector_to_matrix(random.normal(size=(4, 3))) @ model.axes,
        model.scales,
        model.weights,
    ).place(np.eye(4)[None])
    frozen = Correlation(covariance="frozen").bind(data, start)
    assert frozen(turned).energy == frozen(start).energy
    assert not frozen(start).wrenches[:, 3:].any()
    exact = Correlation(covariance="exact").bind(data, start)
    assert exact(turned).energy != pytest.approx(exact(start).energy, rel=1e-3)


def test_far_apart_overlap_is_nothing_but_finite(random):
    model, data = gaussians(3, random), cloud(50, random)
    far = model.place(rigid(np.eye(3), np.array([100.0, 0.0, 0.0]))[None])
    response = Correlation().bind(data, far)(far)
    assert abs(response.energy) < 1e-200
    assert np.isfinite(response.wrenches).all()


def test_blur_reaches_further(random):
    model, data = gaussians(1, random), cloud(30, random)
    away = model.place(rigid(np.eye(3), np.array([1.5, 0.0, 0.0]))[None])
    sharp = Correlation().bind(data, away)(away)
    blurred = Correlation().bind(data, away, smoothing=0.3)(away)
    assert np.abs(blurred.wrenches[0, :3]).max() > 1e3 * np.abs(sharp.wrenches[0, :3]).max()
