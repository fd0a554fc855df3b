"""Shape and pose fitted with the skin of a template: derivatives, and bodies found again."""

import numpy as np
import pytest

from regkit.body.linear_shape import LinearShape
from regkit.calibration.skin import Measured, fitted, measured, skin_distances
from regkit.calibration.skin.posed_skin import PosedSkin
from regkit.calibration.skin.skin_distances import SkinDistances
from regkit.calibration.skin.skin_points import SkinPoints
from regkit.geometry.camera import Camera
from regkit.geometry.rigid import inverse, rigid, transformed
from regkit.geometry.rotation import vector_to_matrix
from regkit.observation import Observation, View
from regkit.sensors.raycast import ray_cast
from regkit.skeleton import Pose
from regkit_plugins.solvers.gauss_newton import GaussNewton
from regkit_plugins.templates.hand import Hand
from regkit_plugins.templates.human import Human

CAMERA = Camera(width=160, height=120, fx=180.0, fy=180.0, cx=79.5, cy=59.5)
SOLVER = GaussNewton(max_iterations=12, value_tolerance=1e-3)


@pytest.fixture(scope="module")
def hand() -> LinearShape:
    return LinearShape.of(Hand().description())


def drawn(shape: LinearShape, seed: int) -> np.ndarray:
    factor = np.linalg.cholesky(np.linalg.inv(shape.information))
    random = np.random.default_rng(seed).normal(size=len(shape))
    return np.clip(shape.mean + 2.0 * factor @ random, *shape.bounds.T)


def posed(shape: LinearShape, x: np.ndarray, seed: int, away: float = 0.5) -> Pose:
    bones, random = shape.skeleton(x), np.random.default_rng(seed)
    root = rigid(vector_to_matrix(random.normal(size=3)), np.array([0.0, 0.0, away]))
    step = np.zeros(bones.dofs)
    step[6:] = 0.15 * random.normal(size=bones.dofs - 6)
    return bones.limits.projected(bones.retract(bones.rest(root), step))


def near(shape: LinearShape, x: np.ndarray, pose: Pose) -> Pose:
    bones = shape.skeleton(x)
    step = 0.05 * np.random.default_rng(9).normal(size=bones.dofs)
    step[:3] *= 0.1
    return bones.limits.projected(bones.retract(pose, step))


def scanned(shape: LinearShape, x: np.ndarray, pose: Pose, count: int = 4000) -> Measured:
    vertices, random = PosedSkin.of(shape, x, pose).vertices, np.random.default_rng(3)
    corners = vertices[shape.mesh.faces[random.integers(len(shape.mesh.faces), size=count)]]
    shares = random.dirichlet(np.ones(3), count)
    points = np.einsum("nc,nci->ni", shares, corners)
    ones = np.ones(count)
    return Measured.of(Observation(points, ones, 1e-6 * ones))


def error(shape: LinearShape, x: np.ndarray, truth: np.ndarray) -> float:
    off = shape.skin(x).vertices - shape.skin(truth).vertices
    return float(np.linalg.norm(off - off.mean(axis=0), axis=1).mean())


@pytest.mark.parametrize("template", [Hand(), Human()])
def test_derivatives_of_distances_are_those_of_finite_differences(template):
    shape = LinearShape.of(template.description())
    x = drawn(shape, 0)
    pose = posed(shape, x, 1)
    random = np.random.default_rng(2)
    points = SkinPoints.on(shape.mesh.faces)
    chosen = random.integers(len(points.corners), size=30)
    directions = random.normal(size=(30, 3))
    directions /= np.linalg.norm(directions, axis=1, keepdims=True)
    data = random.normal(size=(30, 3))
    corners, shares = points.corners[chosen], points.shares[chosen]
    held = SkinPoints(corners, shares)

    def lengths(coefficients: np.ndarray, at: Pose) -> np.ndarray:
        placed = held.place(PosedSkin.of(shape, coefficients, at).vertices)
        return ((data - placed) * directions).sum(axis=1)

    skin = PosedSkin.of(shape, x, pose)
    found = SkinDistances(lengths(x, pose), directions, corners, shares)
    to_shape, to_pose = skin.rows(found)
    bones, step = shape.skeleton(x), 1e-5
    for axis in range(len(x)):
        nudge = step * np.eye(len(x))[axis]
        slope = (lengths(x + nudge, pose) - lengths(x - nudge, pose)) / (2.0 * step)
        np.testing.assert_allclose(to_shape[:, axis], slope, atol=1e-7)
    for axis in range(bones.dofs):
        nudge = step * np.eye(bones.dofs)[axis]
        there, back = (bones.retract(pose, sign * nudge) for sign in (1.0, -1.0))
        slope = (lengths(x, there) - lengths(x, back)) / (2.0 * step)
        np.testing.assert_allclose(to_pose[:, axis], slope, atol=1e-7)


def test_shape_of_a_whole_scan_is_found_again(hand):
    truth = drawn(hand, 5)
    pose = posed(hand, truth, 6)
    scan = scanned(hand, truth, pose)
    start = hand.at_size(hand.size(truth))
    found = fitted(hand, start, [scan], [near(hand, truth, pose)], SOLVER)
    gaps = skin_distances(hand, found.coefficients, [scan], found.poses)
    assert np.median(np.abs(gaps)) < 0.6e-3
    assert error(hand, found.coefficients, truth) < 0.6 * error(hand, start, truth)


def test_one_shape_is_found_in_several_depth_images(hand):
    truth = drawn(hand, 7)
    poses = [posed(hand, truth, seed, away=0.4) for seed in (10, 11)]
    frames = []
    for pose in poses:
        vertices = PosedSkin.of(hand, truth, pose).vertices
        depth = ray_cast(vertices, hand.mesh.faces, CAMERA)
        points = CAMERA.back_projected(depth)
        ones = np.ones(len(points))
        frames.append(Measured.of(Observation(points, ones, 1e-6 * ones, CAMERA, depth)))
    start = hand.at_size(hand.size(hand.mean))
    starts = [near(hand, truth, pose) for pose in poses]
    found = fitted(hand, start, frames, starts, SOLVER)
    assert np.median(np.abs(skin_distances(hand, found.coefficients, frames, found.poses))) < 1e-3
    assert error(hand, found.coefficients, truth) < 0.85 * error(hand, start, truth)


def seen_from(shape: LinearShape, vertices: np.ndarray, T_world_camera: np.ndarray) -> View:
    there = transformed(inverse(T_world_camera), vertices)
    depth = ray_cast(there, shape.mesh.faces, CAMERA)
    points = CAMERA.back_projected(depth)
    ones = np.ones(len(points))
    return View("", T_world_camera, Observation(points, ones, 1e-6 * ones, CAMERA, depth))


def test_distances_in_several_views_are_those_of_each_in_the_world(hand):
    pose = posed(hand, hand.mean, 12, away=0.4)
    vertices = PosedSkin.of(hand, hand.mean, pose).vertices
    turn = rigid(vector_to_matrix(np.array([0.2, 1.1, 0.3])), np.array([-0.35, 0.1, 0.2]))
    views = [seen_from(hand, vertices, camera) for camera in (np.eye(4), turn)]
    moved = vertices + np.array([0.004, -0.003, 0.002])
    skin, whole = SkinPoints.on(hand.mesh.faces), measured(Observation.of_views(views))
    found = whole.distances(skin, moved, 0.19)
    for side, (first, second) in zip(found, zip(*(
        measured(view.data, 0.5).distances(skin, transformed(view.to_camera, moved), 0.19)
        for view in views
    ), strict=True), strict=True):  # fmt: skip
        assert len(side) == len(first) + len(second)
        np.testing.assert_allclose(side.lengths, [*first.lengths, *second.lengths])
        world = second.directions @ turn[:3, :3].T
        np.testing.assert_allclose(side.directions, [*first.directions, *world])


@pytest.mark.long
def test_two_cameras_show_more_of_a_shape_than_one(hand):
    truth = drawn(hand, 7)
    pose = posed(hand, truth, 10, away=0.4)
    vertices = PosedSkin.of(hand, truth, pose).vertices
    middle = vertices.mean(axis=0)
    turn = vector_to_matrix(np.array([0.0, np.pi, 0.0]))
    behind = rigid(turn, middle - turn @ middle)
    views = [seen_from(hand, vertices, camera) for camera in (np.eye(4), behind)]
    start, errors = hand.at_size(hand.size(hand.mean)), []
    for several in (views[:1], views):
        frame = measured(Observation.of_views(several))
        found = fitted(hand, start, [frame], [near(hand, truth, pose)], SOLVER)
        errors.append(error(hand, found.coefficients, truth))
    assert errors[1] < errors[0]
    assert errors[1] < 0.8 * error(hand, start, truth)


@pytest.mark.long
def test_missing_parts_of_a_scan_do_not_shrink_the_body(hand):
    truth = drawn(hand, 5)
    pose = posed(hand, truth, 6)
    scan = scanned(hand, truth, pose)
    # Half of the hand is not scanned.
    axis = scan.points - scan.points.mean(axis=0)
    kept = axis @ np.linalg.svd(axis, full_matrices=False)[2][2] > 0.0
    ones = np.ones(int(kept.sum()))
    half = Measured.of(Observation(scan.points[kept], ones, 1e-6 * ones))
    start = hand.at_size(hand.size(truth))
    found = fitted(hand, start, [half], [near(hand, truth, pose)], SOLVER)
    assert hand.size(found.coefficients) == pytest.approx(hand.size(truth), rel=0.02)
