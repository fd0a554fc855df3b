"""Laws of the sphere-mesh and of the distance to it."""

from dataclasses import replace

import numpy as np
import pytest

from regkit.geometry.camera import Camera
from regkit.geometry.capsules import Capsules
from regkit.geometry.rigid import rigid
from regkit.geometry.rotation import vector_to_matrix
from regkit.observation import Observation
from regkit.primitives import TaperedCapsules
from regkit.registration import COORDINATES, RegistrationProblem
from regkit.system.errors import ConfigError
from regkit_plugins.kernels.sphere_distance.sphere_distance import SphereDistance
from regkit_plugins.shapes.sphere import SphereMesh
from regkit_plugins.solvers.gauss_newton import GaussNewton
from regkit_plugins.terms.visibility.visibility import visible_shares

CAMERA = Camera(width=176, height=144, fx=230.0, fy=230.0, cx=87.5, cy=71.5)
SHAPES = [SphereMesh(), SphereMesh(variant="spheres")]
SQUARES = SphereDistance(side="whole", robust={"loss": "squares", "scale": 0.01})


def shape_name(shape) -> str:
    return shape.variant


def posed(linkage, random, spread=0.5):
    bones = linkage.skeleton
    root = rigid(vector_to_matrix(random.normal(size=3)), np.array([0.2, -0.1, 2.0]))
    return bones.retract(bones.rest(root), spread * random.normal(size=bones.dofs))


def cloud(points, camera=CAMERA, weights=None):
    count = len(points)
    weights = np.ones(count) if weights is None else weights
    return Observation(points, weights, np.full(count, 0.01**2), camera)


def one(start, end, first, last) -> Capsules:
    return Capsules(np.zeros(1, dtype=np.intp), np.array([[start, end]]), np.array([[first, last]]))


def placed_of(linkage, capsules: Capsules, shape=SHAPES[0]):
    """Capsules as primitives, where they are."""
    body = replace(linkage, capsules=capsules)
    return shape.bind(body).place(np.tile(np.eye(4), (capsules.segments.max() + 1, 1, 1)))


def distances(placed, points, kernel=SQUARES, camera=None):
    """Absolute residuals of single points, from the energy of squares."""
    energies = [kernel.bind(cloud(p[None], camera), placed)(placed).energy for p in points]
    # The energy of one point is r^2 / (2 s^2), and nothing else where s is that of the data.
    return 0.01 * np.sqrt(2.0 * np.array(energies))


@pytest.mark.parametrize("side", ["front", "whole"])
def test_stiffness_is_the_sum_of_the_squared_slopes(linkage, random, side):
    """By brute force: each point alone, whose slope is that of its own residual."""
    kernel = SphereDistance(side=side, robust={"loss": "squares", "scale": 0.01})
    primitives = SHAPES[0].bind(linkage)
    placed = primitives.place(linkage.place(posed(linkage, random)).transforms)
    points = placed.centres[2] + random.normal(scale=0.06, size=(30, 3))
    blocks = kernel.bind(cloud(points), placed)(placed, curvature=True).stiffness
    expected = np.zeros_like(blocks)
    for point in points:
        # With E = r^2 / (2 s^2) the slope of r is that of E times s^2 / r.
        alone = kernel.bind(cloud(point[None]), placed)(placed)
        slope = alone.wrenches / np.sqrt(2.0 * alone.energy) / 30**0.5
        expected += slope[:, :, None] * slope[:, None, :]
    np.testing.assert_allclose(blocks, expected, atol=1e-9 * np.abs(expected).max())


def sampled_surface(capsules: Capsules, count: int, random) -> np.ndarray:
    """Points of the mantles and of the end spheres that lie on the surface of the union."""
    axes = capsules.ends[:, 1] - capsules.ends[:, 0]
    lengths = np.linalg.norm(axes, axis=1)[:, None, None]
    units = axes[:, None] / lengths
    free = random.normal(size=(len(capsules), count, 3))
    around = free - (free * units).sum(axis=2, keepdims=True) * units
    around /= np.linalg.norm(around, axis=2, keepdims=True)
    free /= np.linalg.norm(free, axis=2, keepdims=True)
    sines = (capsules.radii[:, :1, None] - capsules.radii[:, 1:, None]) / lengths
    mantle = sines * units + np.sqrt(1.0 - sines**2) * around
    some = random.uniform(size=(len(capsules), count, 1))
    samples = []
    for normals, along in ((mantle, some), (free, np.round(some))):
        centres = (1.0 - along) * capsules.ends[:, :1] + along * capsules.ends[:, 1:]
        radii = (1.0 - along) * capsules.radii[:, :1, None] + along * capsules.radii[:, 1:, None]
        samples.append((centres + radii * normals).reshape(-1, 3))
    points = np.concatenate(samples)
    return points[capsules.surface_distance(points) > -1e-7]


def test_distance_is_that_of_the_nearest_sampled_point_of_the_surface(linkage, random):
    """Outside the union, and inside where its surface is that of one capsule."""
    capsules = Capsules(
        segments=np.arange(3),
        ends=random.normal(scale=0.15, size=(3, 2, 3)),
        radii=random.uniform(0.03, 0.1, size=(3, 2)),
    )
    points = random.normal(scale=0.3, size=(60, 3))
    points = points[capsules.surface_distance(points) > 0.0]
    single = capsules.selected(np.array([True, False, False]))
    within = single.ends[0].mean(axis=0) + random.normal(scale=0.02, size=(30, 3))
    assert len(points) > 30
    assert (single.surface_distance(within) < 0.0).all()
    for model, some in ((capsules, points), (single, within)):
        surface = sampled_surface(model, 60_000, random)
        expected = [np.linalg.norm(surface - point, axis=1).min() for point in some]
        found = distances(placed_of(linkage, model), some)
        assert (found <= np.array(expected) + 1e-7).all()
        np.testing.assert_allclose(found, expected, atol=1e-3)


@pytest.mark.parametrize("shape", SHAPES, ids=shape_name)
def test_distance_is_that_of_the_nearest_of_all_spheres(linkage, random, shape):
    """By brute force over spheres, of which the variant ``spheres`` has few."""
    capsules = Capsules(
        segments=np.arange(4),
        ends=random.normal(scale=0.2, size=(4, 2, 3)),
        radii=random.uniform(0.03, 0.1, size=(4, 2)),
    )
    dense = SphereMesh(variant="spheres", spacing=0.003)
    spheres = placed_of(linkage, capsules, shape if shape.variant == "spheres" else dense)
    points = random.normal(scale=0.3, size=(100, 3))
    apart = np.linalg.norm(points[:, None] - spheres.centres, axis=2)
    expected = (apart - spheres.primitives.radii[:, 0]).min(axis=1)
    assert (expected < 0.0).any()
    found = distances(placed_of(linkage, capsules, shape), points)
    np.testing.assert_allclose(found, np.abs(expected), atol=1e-5)


def test_a_larger_sphere_that_holds_the_other_is_the_capsule(linkage, random):
    points = random.normal(scale=0.4, size=(50, 3))
    centre, beside = np.array([0.1, 0.0, 0.3]), np.array([0.1, 0.1, 0.3])
    expected = np.abs(np.linalg.norm(points - centre, axis=1) - 0.2)
    for capsule in (
        one(centre, beside, 0.2, 0.1),
        one(beside, centre, 0.05, 0.2),
        one(centre, centre, 0.2, 0.2),
    ):
        np.testing.assert_allclose(distances(placed_of(linkage, capsule), points), expected)


def test_shape_scales_with_the_body(linkage, random):
    primitives = SHAPES[0].bind(linkage)
    larger = primitives.scaled(1.7)
    np.testing.assert_allclose(larger.sines, primitives.sines)
    points = random.normal(scale=0.3, size=(20, 3))
    at_rest = np.tile(np.eye(4), (len(linkage.skeleton.names), 1, 1))
    np.testing.assert_allclose(
        distances(larger.place(at_rest), 1.7 * points),
        1.7 * distances(primitives.place(at_rest), points),
    )


def test_front_draws_back_what_stands_too_near_and_the_whole_does_not(linkage, random):
    """Energies of a limb's front while the limb comes up to two and a half radii too near."""
    placed = placed_of(linkage, one([-0.2, 0.0, 2.0], [0.2, 0.0, 2.0], 0.05, 0.05))
    angles = random.uniform(-0.5 * np.pi, 0.5 * np.pi, size=300)
    across, deep = 0.05 * np.sin(angles), -0.05 * np.cos(angles)
    surface = np.column_stack([random.uniform(-0.2, 0.2, 300), across, 2.0 + deep])
    nearer = [np.array([0.0, 0.0, shift]) for shift in np.linspace(0.0, 0.125, 20)]

    def energies(side, camera):
        kernel = SphereDistance(side=side, robust={"loss": "squares", "scale": 0.01})
        clouds = [cloud(surface + shift, camera) for shift in nearer]
        return np.array([kernel.bind(data, placed)(placed).energy for data in clouds])

    front, whole = energies("front", CAMERA), energies("whole", CAMERA)
    assert (np.diff(front) > 0.0).all()
    assert (np.diff(whole) < 0.0).any()
    np.testing.assert_array_equal(energies("front", None), whole)


def test_points_belong_to_what_takes_part(linkage):
    """Of two alike, one hidden: the handicap of a twentieth is 2.4 deviations."""
    two = Capsules(
        segments=np.arange(2),
        ends=np.array([[[-0.1, 0.0, 2.0]] * 2, [[0.1, 0.0, 2.0]] * 2]),
        radii=np.full((2, 2), 0.05),
    )
    placed = placed_of(linkage, two)
    points = np.array([[0.005, 0.0, 2.0], [0.04, 0.0, 2.0]])
    kernel = SphereDistance(robust={"scale": 0.02}, side="whole")
    hidden = replace(placed, primitives=replace(placed.primitives, weights=np.array([1.0, 0.05])))
    for point, equal, unequal in zip(points, (1, 1), (0, 1), strict=True):
        for where, owner in ((placed, equal), (hidden, unequal)):
            wrenches = kernel.bind(cloud(point[None]), where)(where).wrenches
            assert wrenches[owner, 0] != 0.0
            assert not wrenches[1 - owner].any()


def test_energy_is_the_mean_loss_and_the_logarithm_of_its_scale(linkage, random):
    primitives = SHAPES[0].bind(linkage)
    placed = primitives.place(linkage.place(posed(linkage, random)).transforms)
    points = placed.centres[2] + random.normal(scale=0.1, size=(51, 3))
    gaps = distances(placed, points)
    scale = np.median(gaps) / 0.6744897501960817
    for loss, mean in (("squares", 0.5 * (gaps / scale) ** 2), (
        "geman_mcclure", 0.5 * (gaps / scale) ** 2 / (1.0 + (gaps / scale / 3.787) ** 2)
    )):  # fmt: skip
        kernel = SphereDistance(side="whole", robust={"loss": loss})
        found = kernel.bind(cloud(points), placed)(placed).energy
        assert found == pytest.approx(mean.mean() + np.log(scale / 0.01))


def test_points_are_explained_where_the_surface_is_and_nowhere_else(linkage):
    placed = placed_of(linkage, one([0.0, 0.0, 2.0], [0.2, 0.0, 2.0], 0.05, 0.03))
    points = np.array([[0.0, 0.0, 1.95], [0.2, 0.03, 2.0], [0.1, 0.0, 1.0], [1.0, 1.0, 2.0]])
    data = cloud(points)
    for loss in ("tukey", "geman_mcclure"):
        kernel = SphereDistance(robust={"loss": loss, "scale": 0.01})
        explained = kernel.bind(data, placed).inlier_probability(placed)
        assert (explained[:2] > 0.9).all()
        np.testing.assert_allclose(explained[2:], 0.0, atol=1e-3)
    assert SQUARES.bind(data, placed).inlier_probability(placed) is None


@pytest.mark.parametrize("shape", SHAPES, ids=shape_name)
def test_pose_is_found_again(linkage, random, shape):
    """From 5 degrees and 3 cm away, by the surface that a camera sees."""
    truth = posed(linkage, random, spread=0.2)
    bones = linkage.skeleton
    truth = bones.limits.projected(truth)
    primitives = shape.bind(linkage)
    placed = primitives.place(linkage.place(truth).transforms)
    ways = primitives.halves[:, None, None] * placed.axes[:, None, :, 1]
    middles = placed.centres[:, None] + ways * random.uniform(-1, 1, (len(primitives), 200, 1))
    normals = random.normal(size=(len(primitives), 200, 3))
    normals /= np.linalg.norm(normals, axis=2, keepdims=True)
    capsules = linkage.capsules.place(linkage.place(truth).transforms)
    points = (middles + primitives.radii.mean(axis=1)[:, None, None] * normals).reshape(-1, 3)
    seen = (points * normals.reshape(-1, 3)).sum(axis=1) < 0.0
    seen &= np.abs(capsules.surface_distance(points)) < 4e-3
    data = cloud(points[seen])
    start = bones.limits.projected(
        bones.retract(truth, np.r_[np.full(3, 0.03), np.full(bones.dofs - 3, 0.09)])
    )
    there = primitives.place(linkage.place(start).transforms)
    similarity = SphereDistance().bind(data, there)
    problem = RegistrationProblem(
        COORDINATES["tangent"](bones, start), primitives, {"kernel": similarity}
    )
    solution = GaussNewton(max_iterations=30).minimize(problem)
    found = COORDINATES["tangent"](bones, start).pose(solution.x)
    before, after = (
        np.linalg.norm(
            linkage.markers.place(linkage.place(pose).transforms)
            - linkage.markers.place(linkage.place(truth).transforms),
            axis=1,
        ).max()
        for pose in (start, found)
    )
    assert before > 0.03
    assert after < 0.008


def test_sphere_behind_a_capsule_is_hidden(linkage):
    """The term ``visibility`` takes the capsule as an ellipsoid."""
    two = Capsules(
        segments=np.arange(2),
        ends=np.array([[[-0.2, 0.0, 2.0], [0.2, 0.0, 2.0]], [[0.1, 0.0, 2.5]] * 2]),
        radii=np.array([[0.06, 0.05], [0.02, 0.02]]),
    )
    np.testing.assert_allclose(
        visible_shares(placed_of(linkage, two), np.ones(2, dtype=bool)), [1.0, 0.0], atol=1e-12
    )


def test_template_without_capsules_is_refused(linkage):
    none = linkage.capsules.selected(np.zeros(len(linkage.capsules), dtype=bool))
    with pytest.raises(ConfigError, match=r"'linkage' has no capsules.*'sphere'"):
        SphereMesh().bind(replace(linkage, capsules=none))


def test_spheres_are_close_enough_and_end_where_the_capsules_do(linkage):
    spheres = SphereMesh(variant="spheres", spacing=0.5).bind(linkage)
    assert isinstance(spheres, TaperedCapsules)
    assert not spheres.halves.any()
    for segment, ends, radii in zip(
        linkage.capsules.segments, linkage.capsules.ends, linkage.capsules.radii, strict=True
    ):
        own = spheres.centres[spheres.segments == segment]
        assert np.linalg.norm(np.diff(own, axis=0), axis=1).max() <= 0.5 * radii.mean() + 1e-12
        np.testing.assert_allclose(own[[0, -1]], ends)
