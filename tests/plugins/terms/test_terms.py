"""Laws of the terms: their gradients, and what each of them is for."""

from dataclasses import replace

import numpy as np
import pytest

from regkit.geometry.camera import Camera
from regkit.geometry.rigid import rigid
from regkit.geometry.rotation import vector_to_matrix
from regkit.interfaces import Prior, Scene, VisibilityWeights
from regkit.observation import Observation
from regkit.primitives import Gaussians
from regkit.system.errors import ConfigError
from regkit_plugins.kernels.correlation import Correlation
from regkit_plugins.shapes.gsog import GeneralizedSumOfGaussians
from regkit_plugins.terms.clamp import Clamp
from regkit_plugins.terms.continuity import Continuity
from regkit_plugins.terms.free_space import FreeSpace
from regkit_plugins.terms.intersection import Intersection
from regkit_plugins.terms.limits import LimitsTerm
from regkit_plugins.terms.visibility import Visibility

CAMERA = Camera(width=176, height=144, fx=230.0, fy=230.0, cx=87.5, cy=71.5)


def posed(linkage, random, spread=0.9):
    bones = linkage.skeleton
    root = rigid(vector_to_matrix(random.normal(size=3)), np.array([0.2, -0.1, 2.0]))
    return bones.retract(bones.rest(root), spread * random.normal(size=bones.dofs))


def scene_at(linkage, random, shape, start):
    primitives = shape.bind(linkage)
    # Twice as large, so that parts that are no neighbours meet.
    primitives = replace(primitives, scales=2.0 * primitives.scales)
    placed = primitives.place(linkage.place(start).transforms)
    chosen = random.integers(len(primitives), size=250)
    points = placed.centres[chosen] + random.normal(scale=0.03, size=(250, 3))
    depth = np.zeros((CAMERA.height, CAMERA.width))
    depth[40:100, 90:120] = 2.1  # A silhouette that the linkage is partly beside, partly before.
    data = Observation(points, np.ones(250), np.full(250, 0.01**2), CAMERA, depth)
    return Scene(linkage, data, Prior(start), placed), primitives


def before_camera(scales, centres, segments=(0, 1)):
    """Two primitives, each on its own segment, that are where they are told to be."""
    primitives = Gaussians(
        np.array(segments), np.array(centres), np.tile(np.eye(3), (2, 1, 1)),
        np.array(scales), np.ones(2),
    )  # fmt: skip
    return primitives.place(np.tile(np.eye(4), (max(segments) + 1, 1, 1)))


def scene_of(linkage, placed, depth=None):
    camera = None if depth is None else CAMERA
    data = Observation(np.zeros((1, 3)), np.ones(1), np.ones(1), camera, depth)
    return Scene(linkage, data, Prior(linkage.skeleton.rest()), placed)


BALL = [0.1, 0.1, 0.1]


def test_hidden_primitive_takes_hardly_part(linkage):
    shown = before_camera([BALL, BALL], [[0.0, 0.0, 2.0], [0.8, 0.0, 3.0]])
    behind = before_camera([BALL, BALL], [[0.0, 0.0, 2.0], [0.0, 0.0, 3.0]])
    depth = np.zeros((CAMERA.height, CAMERA.width))
    term = Visibility(least=0.1)
    np.testing.assert_array_equal(term.bind(scene_of(linkage, shown, depth)).factors, [1.0, 1.0])
    np.testing.assert_array_equal(term.bind(scene_of(linkage, behind, depth)).factors, [1.0, 0.1])
    np.testing.assert_array_equal(term.bind(scene_of(linkage, behind)).factors, [1.0, 1.0])


def test_what_may_be_missing_hides_nothing_and_may_be_in_free_space(linkage):
    depth = np.zeros((CAMERA.height, CAMERA.width))
    depth[:, 80:96] = 2.0
    beside = before_camera([BALL, BALL], [[0.5, 0.0, 2.0], [0.0, 0.0, 2.1]])
    behind = before_camera([BALL, BALL], [[0.0, 0.0, 2.0], [0.0, 0.0, 3.0]])
    missing = replace(linkage, optional=(0,))
    factors = Visibility().bind(scene_of(missing, behind, depth)).factors
    np.testing.assert_array_equal(factors, [1.0, 1.0])
    assert FreeSpace().bind(scene_of(missing, beside, depth))(beside).energy == 0.0
    assert FreeSpace().bind(scene_of(linkage, beside, depth))(beside).energy > 0.0


def test_half_hidden_primitive_takes_part_by_half(linkage):
    placed = before_camera([BALL, [0.3, 0.1, 0.1]], [[0.25, 0.0, 2.0], [0.0, 0.0, 2.6]])
    depth = np.zeros((CAMERA.height, CAMERA.width))
    shares = Visibility().bind(scene_of(linkage, placed, depth))
    assert isinstance(shares, VisibilityWeights)
    assert 0.3 < shares.factors[1] < 1.0


def test_intersection_pushes_strangers_apart_and_leaves_neighbours_alone(linkage):
    names = linkage.skeleton.names
    centres = [[0.0, 0.0, 2.0], [0.05, 0.0, 2.0]]
    base, arm, leg = (names.index(name) for name in ("base", "arm", "leg"))
    strangers = before_camera([BALL, BALL], centres, (arm, leg))
    response = Intersection().bind(scene_of(linkage, strangers))(strangers)
    assert response.energy > 0.0
    assert response.wrenches[0, 0] > 0.0 > response.wrenches[1, 0]  # Downhill is apart.
    np.testing.assert_allclose(response.wrenches[0, :3], -response.wrenches[1, :3])
    neighbours = before_camera([BALL, BALL], centres, (base, arm))
    assert Intersection().bind(scene_of(linkage, neighbours))(neighbours).energy == 0.0


def test_free_space_draws_into_the_silhouette_and_behind_the_surface(linkage):
    depth = np.zeros((CAMERA.height, CAMERA.width))
    depth[:, 80:96] = 2.0
    placed = before_camera([BALL, BALL], [[0.5, 0.0, 2.1], [0.0, 0.0, 1.5]])
    response = FreeSpace().bind(scene_of(linkage, placed, depth))(placed)
    assert response.wrenches[0, 0] > 0.0  # Downhill is to the left, into the silhouette.
    assert response.wrenches[1, 2] < 0.0  # Downhill is away from the camera.
    inside = before_camera([BALL, BALL], [[0.0, 0.0, 2.1], [0.0, 0.3, 2.5]])
    assert FreeSpace().bind(scene_of(linkage, inside, depth))(inside).energy == 0.0
    assert FreeSpace().bind(scene_of(linkage, placed))(placed).energy == 0.0


def test_continuity_costs_the_square_of_the_turn(linkage):
    bones = linkage.skeleton
    scene = Scene(linkage, None, Prior(bones.rest()), None)
    energy = Continuity(weight=2.0, joint_deg=10.0).bind(scene)
    step = np.zeros(bones.dofs)
    step[bones.dofs_of("forearm")] = np.radians(20.0)
    assert energy(bones.retract(bones.rest(), step)).energy == pytest.approx(0.5 * 2.0 * 4.0)
    step[:6] = 1.0  # The root is free.
    assert energy(bones.retract(bones.rest(), step)).energy == pytest.approx(0.5 * 2.0 * 4.0)


def test_continuity_of_an_unknown_joint_is_refused(linkage):
    term = Continuity(joints_deg={"forarm": 5.0})
    with pytest.raises(ConfigError, match=r"'forarm'.*did you mean 'forearm'"):
        term.check(linkage)


def test_limits_cost_nothing_within_and_agree_with_the_violation(linkage, random):
    bones = linkage.skeleton
    energy = LimitsTerm(weight=1.0, tolerance_deg=10.0).bind(Scene(linkage, None, None, None))
    within = bones.limits.projected(posed(linkage, random))
    assert energy(within).energy == pytest.approx(0.0, abs=1e-20)
    step = np.zeros(bones.dofs)
    step[bones.dofs_of("forearm")] = np.radians(150.0)  # Its limit is 140 degrees.
    assert energy(bones.retract(bones.rest(), step)).energy == pytest.approx(0.5)


def test_clamp_makes_of_the_correlation_the_smaller_of_overlap_and_own(linkage, random):
    """Against brute force over all pairs, with one variance of the data."""
    start = posed(linkage, random, 0.2)
    scene, _ = scene_at(linkage, random, GeneralizedSumOfGaussians(), start)
    data, placed = scene.observation, scene.placed
    kernel = Correlation().bind(data, placed)(placed).energy
    excess = Clamp().bind(scene)(placed).energy
    variance = data.variances[0] * np.eye(3)
    overlaps = np.zeros(len(data.points))
    for mean, covariance in zip(placed.centres, placed.covariances(), strict=True):
        both = covariance + variance
        offsets = data.points - mean
        squares = np.einsum("ni,ij,nj->n", offsets, np.linalg.inv(both), offsets)
        overlaps += np.sqrt(np.linalg.det(covariance) / np.linalg.det(both)) * np.exp(-squares / 2)
    own = np.sqrt(np.linalg.det(variance) / np.linalg.det(2.0 * variance))
    assert kernel + excess == pytest.approx(-np.minimum(overlaps, own).mean(), rel=1e-9)
