"""Laws of every kernel of Gaussians, whole or as a camera sees them."""

import numpy as np
import pytest

from regkit.gaussians.visible import Visible, seen
from regkit.geometry.camera import Camera
from regkit.geometry.rigid import rigid
from regkit.geometry.rotation import vector_to_matrix
from regkit.observation import Observation
from regkit.primitives import Gaussians, SurfaceGaussians
from regkit_plugins.kernels.correlation import Correlation
from regkit_plugins.kernels.likelihood import Likelihood
from regkit_plugins.shapes.gsog import GeneralizedSumOfGaussians

CAMERA = Camera(width=176, height=144, fx=230.0, fy=230.0, cx=87.5, cy=71.5)
KERNELS = [
    Correlation(), Correlation(covariance="frozen"), Likelihood(), Likelihood(covariance="frozen")
]  # fmt: skip


def name(plugin) -> str:
    return "-".join(str(value) for value in plugin.model_dump().values())


def scene(linkage, random, shape):
    """A posed linkage before the camera, and anisotropic data about it."""
    bones = linkage.skeleton
    root = rigid(vector_to_matrix(random.normal(size=3)), np.array([0.2, -0.1, 2.0]))
    start = bones.retract(bones.rest(root), 0.5 * random.normal(size=bones.dofs))
    primitives = shape.bind(linkage)
    points = start.root[:3, 3] + random.normal(size=(250, 3)) * [0.3, 0.2, 0.15]
    variances = random.choice([0.01, 0.03], size=250) ** 2
    data = Observation(points, random.uniform(0.5, 2.0, 250), variances, CAMERA)
    return start, primitives, data


def pair_weights(kernel, view, precisions, points):
    """By brute force, (K, N): the overlaps, or the Gaussians' shares of the points."""
    offsets = points - view.means[:, None, :]
    squares = np.einsum("kni,kij,knj->kn", offsets, precisions, offsets)
    densities = np.exp(-0.5 * squares) * np.sqrt(np.linalg.det(precisions))[:, None]
    if kernel.kind == "correlation":
        return densities * np.exp(0.5 * view.log_volumes())[:, None] / len(points)
    mixing = (1.0 - kernel.outliers) * view.areas() / view.areas().sum()
    densities *= mixing[:, None] / (2.0 * np.pi) ** 1.5
    background = kernel.outliers / np.ptp(points, axis=0).prod()
    return densities / (densities.sum(axis=0) + background) / len(points)


@pytest.mark.parametrize("surface", [Gaussians, SurfaceGaussians])
@pytest.mark.parametrize("kernel", KERNELS, ids=name)
def test_stiffness_is_the_hessian_of_the_weighted_residuals(random, kernel, surface):
    """With weights and P held, the Gauss-Newton block is exact: sum w J^T P J, by brute force."""
    model = surface(
        segments=np.zeros(2, dtype=np.intp),
        centres=random.normal(scale=0.1, size=(2, 3)),
        axes=vector_to_matrix(random.normal(size=(2, 3))),
        scales=random.uniform(0.04, 0.1, size=(2, 3)),
        weights=np.ones(2),
    )
    placed = model.place(rigid(np.eye(3), np.array([0.1, 0.0, 1.5]))[None])
    points = np.array([0.1, 0.0, 1.45]) + random.normal(scale=0.1, size=(40, 3))
    data = Observation(points, np.ones(40), np.full(40, 0.02**2), CAMERA)
    blocks = kernel.bind(data, placed)(placed, curvature=True).stiffness
    view = seen(placed, CAMERA)
    precisions = view.precisions(0.02**2)
    weights = pair_weights(kernel, view, precisions, points)
    for index in range(2):
        expected = np.zeros((6, 6))
        for point, weight in zip(points, weights[index], strict=True):
            x, y, z = point - placed.centres[index]
            jacobian = np.array([
                [1, 0, 0, 0, z, -y],
                [0, 1, 0, -z, 0, x],
                [0, 0, 1, y, -x, 0],
            ])  # fmt: skip
            expected += weight * jacobian.T @ precisions[index] @ jacobian
        np.testing.assert_allclose(blocks[index], expected, atol=1e-9 * np.abs(expected).max())


def test_likelihood_is_the_log_density_of_the_mixture(random):
    """By brute force, with volumes, two variances and outliers."""
    model = Gaussians(
        segments=np.zeros(3, dtype=np.intp),
        centres=random.normal(scale=0.1, size=(3, 3)),
        axes=vector_to_matrix(random.normal(size=(3, 3))),
        scales=random.uniform(0.04, 0.1, size=(3, 3)),
        weights=np.ones(3),
    )
    placed = model.place(np.eye(4)[None])
    points = random.normal(scale=0.15, size=(30, 3))
    variances = random.choice([0.01, 0.03], size=30) ** 2
    weights = random.uniform(0.5, 2.0, size=30)
    data = Observation(points, weights, variances)
    found = Likelihood(outliers=0.2).bind(data, placed)(placed).energy
    sorted_scales = np.sort(model.scales, axis=1)
    mixing = sorted_scales[:, 1] * sorted_scales[:, 2]
    mixing = 0.8 * mixing / mixing.sum()
    background = 0.2 / np.ptp(points, axis=0).prod()
    total = 0.0
    for point, weight, variance in zip(points, weights, variances, strict=True):
        density = background
        for share, centre, covariance in zip(
            mixing, placed.centres, placed.covariances(), strict=True
        ):
            spread = covariance + variance * np.eye(3)
            q = point - centre
            normal = np.exp(-0.5 * q @ np.linalg.solve(spread, q))
            density += share * normal / np.sqrt(np.linalg.det(2 * np.pi * spread))
        total -= weight * np.log(density)
    assert found == pytest.approx(total / weights.sum(), rel=1e-10)


def test_visible_side_agrees_with_sampling(random):
    """Mean, covariance and area of an ellipsoid's visible side, as a distant camera sees it."""
    model = SurfaceGaussians(
        segments=np.zeros(1, dtype=np.intp),
        centres=np.zeros((1, 3)),
        axes=vector_to_matrix(random.normal(size=(1, 3))),
        scales=np.array([[0.05, 0.1, 0.03]]),
        weights=np.ones(1),
    )
    ray = np.array([0.0, 0.0, 1.0])
    placed = model.place(rigid(np.eye(3), 1000.0 * ray)[None])
    view = Visible.of(placed)
    # Points of the silhouette's area: lines along the ray that hit the 2-sigma ellipsoid.
    precision = np.linalg.inv(4.0 * placed.covariances()[0])
    lateral = np.column_stack([random.uniform(-0.25, 0.25, (400_000, 2)), np.zeros(400_000)])
    a, b = ray @ precision @ ray, lateral @ precision @ ray
    c = np.einsum("ni,ij,nj->n", lateral, precision, lateral) - 1.0
    hit = b**2 - a * c > 0.0
    depth = (-b[hit] - np.sqrt(b[hit] ** 2 - a * c[hit])) / a
    surface = lateral[hit] + depth[:, None] * ray
    np.testing.assert_allclose(view.means[0] - placed.centres[0], surface.mean(axis=0), atol=5e-4)
    np.testing.assert_allclose(
        view.areas()[0], hit.mean() * 0.25, rtol=1e-2
    )  # Of a square of half a metre.
    # The model keeps the volume's variance across the ray, and takes from it along the ray only.
    along = ray @ view.covariances[0] @ ray
    whole = ray @ placed.covariances()[0] @ ray
    h = 2.0 / np.sqrt(ray @ np.linalg.inv(placed.covariances()[0]) @ ray)
    assert along == pytest.approx(whole - 7.0 / 36.0 * h**2)


def test_without_a_camera_the_whole_gaussians_count(linkage, random):
    _, primitives, data = scene(linkage, random, GeneralizedSumOfGaussians(surface="visible"))
    whole = GeneralizedSumOfGaussians().bind(linkage)
    blind = Observation(data.points, data.weights, data.variances)
    transforms = linkage.place(linkage.skeleton.rest(rigid(np.eye(3), data.points.mean(0))))
    placed = primitives.place(transforms.transforms)
    same = whole.place(transforms.transforms)
    kernel = Likelihood()
    first, second = kernel.bind(blind, placed)(placed), kernel.bind(blind, same)(same)
    assert first.energy == second.energy
    assert kernel.bind(data, placed)(placed).energy != second.energy


def test_gaussians_compete_for_points(random):
    """A Gaussian on data that another explains already is not drawn to them as it is alone."""
    both = Gaussians(
        segments=np.zeros(2, dtype=np.intp),
        centres=np.array([[0.0, 0.0, 0.0], [0.15, 0.0, 0.0]]),
        axes=np.tile(np.eye(3), (2, 1, 1)),
        scales=np.full((2, 3), 0.05),
        weights=np.ones(2),
    )
    points = random.normal(scale=0.05, size=(300, 3))
    data = Observation(points, np.ones(300), np.full(300, 1e-4))
    alone = Gaussians(*(value[1:] for value in vars(both).values()))
    pulls = []
    for model in (both, alone):
        placed = model.place(np.eye(4)[None])
        pulls.append(Likelihood().bind(data, placed)(placed).wrenches[-1, 0])
    assert abs(pulls[0]) < 0.3 * abs(pulls[1])


@pytest.mark.parametrize("kernel", KERNELS, ids=name)
def test_points_are_explained_where_the_primitives_are_and_nowhere_else(kernel):
    """Of two variances, so that each point has to keep its place."""
    model = Gaussians(
        segments=np.zeros(1, dtype=np.intp),
        centres=np.zeros((1, 3)),
        axes=np.eye(3)[None],
        scales=np.array([[0.1, 0.05, 0.05]]),
        weights=np.ones(1),
    )
    placed = model.place(rigid(np.eye(3), np.array([0.0, 0.0, 2.0]))[None])
    points = np.array([[0.0, 0.0, 2.0], [2.0, 0.0, 2.0], [0.05, 0.0, 2.0], [0.0, 1.0, 3.0]])
    data = Observation(points, np.ones(4), np.array([0.02, 0.02, 0.03, 0.03]) ** 2)
    explained = kernel.bind(data, placed).inlier_probability(placed)
    np.testing.assert_allclose(explained[[1, 3]], 0.0, atol=1e-9)
    assert ((explained[[0, 2]] > 0.9) & (explained[[0, 2]] <= 1.0)).all()
