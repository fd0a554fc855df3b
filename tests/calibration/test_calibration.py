"""Proportions of a body, how gaps change with them, and finding them in what a camera sees."""

from pathlib import Path

import numpy as np
import pytest

from regkit.body import Body, BodyDescription
from regkit.body.groups import Groups
from regkit.body.proportions import Proportions
from regkit.body.writing import template_text
from regkit.calibration import Calibration
from regkit.calibration.cloud import Cloud
from regkit.calibration.frames import spread
from regkit.calibration.jacobian import ProportionJacobian
from regkit.calibration.problem import SubjectProblem
from regkit.calibration.shape import Shape
from regkit.calibration.subject import check
from regkit.calibration.subject_shape import ModeShape, ProportionShape, check_distance
from regkit.config.document import Document
from regkit.geometry.camera import Camera
from regkit.geometry.rigid import rigid
from regkit.interfaces import RegistrationResult
from regkit.observation import Observation
from regkit.skeleton import Pose, PoseDescription
from regkit.system.errors import NotFoundError
from regkit.system.optional import one_blas_thread
from regkit.tracking import TrackedFrame
from regkit_plugins.solvers.gauss_newton import GaussNewton
from regkit_plugins.templates.hand import Hand
from regkit_plugins.templates.human import Human

CAMERA = Camera(width=104, height=128, fx=145.0, fy=145.0, cx=51.5, cy=63.5)

HUMAN = Human().description()
FACING = np.diag([1.0, -1.0, -1.0])

STANCES = [
    {"left_upper_arm": [0, 0, 40], "right_upper_arm": [0, 0, -40], "left_shin": 40},
    {"left_upper_arm": [-40, 0, 10], "left_forearm": 60, "right_thigh": [-40, 0, 0]},
    {"right_upper_arm": [-60, 0, -20], "right_forearm": 40, "right_shin": 50},
    {"left_forearm": 90, "right_forearm": 70, "left_thigh": [-50, 0, 10], "left_shin": 60},
]


@pytest.fixture(scope="module")
def linkage_description(tmp_path_factory, linkage_text) -> BodyDescription:
    path = tmp_path_factory.mktemp("linkage") / "linkage.yaml"
    path.write_text(linkage_text)
    return Document.read(path).validated(BodyDescription)


def read_again(description: BodyDescription, tmp_path: Path) -> Body:
    path = tmp_path / "body.yaml"
    path.write_text(template_text(description, "A test.", {}))
    return Document.read(path).validated(BodyDescription).body("read", description.size.value)


def posed(body: Body, joints: dict) -> Pose:
    pose = body.skeleton.pose(PoseDescription(joints=joints))
    return Pose(rigid(FACING, np.array([0.0, 0.0, 2.5])), pose.balls, pose.hinges)


def transformed(body: Body, pose: Pose, random: np.random.Generator, size: float) -> Pose:
    step = size * random.normal(size=body.skeleton.dofs)
    return body.skeleton.limits.projected(body.skeleton.retract(pose, step))


def seen(body: Body, pose: Pose, noise: np.ndarray | float = 0.0) -> Observation:
    """What a depth camera sees of a body: along each ray, steps as long as the surface is far."""
    surface = body.capsules.place(body.place(pose).transforms)
    rays = CAMERA.rays().reshape(-1, 3)
    rays = rays / np.linalg.norm(rays, axis=1, keepdims=True)
    along, far = np.full(len(rays), 1.0), np.full(len(rays), np.inf)
    for _ in range(50):
        going = (along < 4.0) & (far > 1e-3)
        far[going] = surface.surface_distance(along[going, None] * rays[going])
        along[going] += far[going]
    hit = far < 2e-3
    depth = np.where(hit, along * rays[:, 2] + noise, 0.0).reshape(CAMERA.height, CAMERA.width)
    points = CAMERA.back_projected(depth)
    ones = np.ones(len(points))
    return Observation(points, ones, 1e-4 * ones, CAMERA, depth)


def unlike(shape: Shape, random: np.random.Generator) -> np.ndarray:
    """Proportions that differ from the template's by some per cent, (1 + 2 G)."""
    x = 0.06 * random.uniform(-1.0, 1.0, size=len(shape))
    x[0] = -0.08
    return x


# Groups and proportions.


def test_groups_join_left_and_right():
    groups = Groups.of(HUMAN)
    assert set(groups.names) == {
        "pelvis", "chest", "head", "upper_arm", "forearm", "hand", "thigh", "shin", "foot"
    }  # fmt: skip
    names = HUMAN.body("human", 1.7).skeleton.names
    for index, name in enumerate(names):
        assert groups.names[groups.of_segments[index]] in name


def test_groups_of_a_hand_are_its_segments():
    assert len(Groups.of(Hand().description()).names) == 16


def test_bones_of_left_and_right_are_mirror_images():
    groups = Groups.of(HUMAN)
    names = list(HUMAN.body("human", 1.7).skeleton.names)
    for name in names:
        if name.startswith("left_"):
            left = groups.bones[names.index(name)]
            right = groups.bones[names.index(name.replace("left", "right"))]
            np.testing.assert_allclose(left * [-1.0, 1.0, 1.0], right, atol=1e-6)
    np.testing.assert_allclose(groups.bones[names.index("left_thigh")], [0.0, -1.0, 0.0])
    assert groups.bones[names.index("chest")][1] > 0.99


@pytest.mark.parametrize("description", [HUMAN, Hand().description()])
def test_proportions_of_one_change_nothing(description):
    groups = Groups.of(description)
    ones = np.ones(len(groups.names))
    same = Proportions(groups, ones, ones).applied(description)
    size = description.size.value
    assert same.size.value == pytest.approx(size)
    same_as(same.body("one", size), description.body("one", size))


def test_proportions_that_are_all_alike_scale_the_body():
    groups = Groups.of(HUMAN)
    factors = np.full(len(groups.names), 1.2)
    larger = Proportions(groups, factors, factors).applied(HUMAN)
    size = 1.2 * HUMAN.size.value
    assert larger.size.value == pytest.approx(size)
    same_as(larger.body("one", size), HUMAN.body("one", size))


def test_lengths_move_what_hangs_on_a_bone_and_girths_the_rest():
    groups = Groups.of(HUMAN)
    lengths, girths = np.ones((2, len(groups.names)))
    lengths[groups.names.index("thigh")] = 1.1
    girths[groups.names.index("pelvis")] = 0.9
    girths[groups.names.index("forearm")] = 0.8
    subject = Proportions(groups, lengths, girths).applied(HUMAN)
    for side in ("left", "right"):
        before, after = (one.segments[f"{side}_shin"].offset for one in (HUMAN, subject))
        np.testing.assert_allclose(after, 1.1 * np.array(before))
        before, after = (one.segments[f"{side}_thigh"].offset for one in (HUMAN, subject))
        np.testing.assert_allclose(after, 0.9 * np.array(before), atol=1e-6)
        before, after = (one.segments[f"{side}_forearm"] for one in (HUMAN, subject))
        np.testing.assert_allclose(
            after.capsules[0].radius, 0.8 * np.array(before.capsules[0].radius)
        )
        assert after.offset == pytest.approx(before.offset)
    thigh = 0.1 * np.linalg.norm(HUMAN.segments["left_shin"].offset)
    assert subject.size.value - HUMAN.size.value == pytest.approx(thigh, abs=1e-3)


def same_as(one: Body, other: Body) -> None:
    np.testing.assert_allclose(one.skeleton.link_offsets, other.skeleton.link_offsets, atol=1e-9)
    np.testing.assert_allclose(one.capsules.ends, other.capsules.ends, atol=1e-9)
    np.testing.assert_allclose(one.capsules.radii, other.capsules.radii, atol=1e-9)
    np.testing.assert_allclose(one.markers.points, other.markers.points, atol=1e-9)
    for kind, listed in one.shapes.items():
        for own, its in zip(listed.parameters, other.shapes[kind].parameters, strict=True):
            for moment, expected in zip(own.moments(), its.moments(), strict=True):
                np.testing.assert_allclose(moment, expected, atol=1e-9)


def test_a_subject_is_written_and_read_again(tmp_path, random, linkage_description):
    for description in (HUMAN, Hand().description(), linkage_description):
        shape = Shape(description)
        subject = shape.description(unlike(shape, random))
        read = read_again(subject, tmp_path)
        body = subject.body("subject", subject.size.value)
        np.testing.assert_allclose(read.capsules.ends, body.capsules.ends, atol=6e-5)
        np.testing.assert_allclose(read.markers.points, body.markers.points, atol=6e-5)
        np.testing.assert_allclose(
            read.skeleton.link_offsets, body.skeleton.link_offsets, atol=1e-3
        )


# The derivatives.


def test_rows_are_the_derivatives_of_the_surface_distances(linkage_description, random):
    shape = Shape(linkage_description)
    x = unlike(shape, random)
    body = shape.body(x)
    pose = transformed(body, body.skeleton.rest(), random, 0.3)
    points = random.normal(scale=0.4, size=(60, 3))
    cloud = Cloud.of(Observation(points, np.ones(60), np.ones(60)))

    def lengths(body: Body, pose: Pose) -> np.ndarray:
        capsules = body.capsules.place(body.place(pose).transforms)
        sides = (cloud.data_to_model(capsules, 0.1), cloud.model_to_data(capsules)[0])
        return np.concatenate([side.lengths for side in sides])

    placement = body.place(pose)
    capsules = body.capsules.place(placement.transforms)
    sides = (cloud.data_to_model(capsules, 0.1), cloud.model_to_data(capsules)[0])
    proportions = ProportionJacobian(body, placement, shape.groups)
    step = 1e-6
    for number in range(body.skeleton.dofs):
        way = step * np.eye(body.skeleton.dofs)[number]
        ends = [lengths(body, body.skeleton.retract(pose, sign * way)) for sign in (1.0, -1.0)]
        found = np.concatenate([side.rows(placement)[:, number] for side in sides])
        np.testing.assert_allclose(found, (ends[0] - ends[1]) / (2.0 * step), atol=1e-5)
    for number in range(1, len(shape)):
        way = step * np.eye(len(shape))[number]
        ends = [lengths(shape.body(x + sign * way), pose) for sign in (1.0, -1.0)]
        found = np.concatenate([proportions.rows(side)[:, number - 1] for side in sides])
        np.testing.assert_allclose(found, (ends[0] - ends[1]) / (2.0 * step), atol=1e-5)


def test_gradient_of_the_joint_problem_is_that_of_its_value(linkage_description, random):
    shape = Shape(linkage_description)
    start = unlike(shape, random)
    body = shape.body(start)
    poses = [transformed(body, body.skeleton.rest(), random, 0.3) for _ in range(2)]
    clouds = [
        Cloud.of(Observation(random.normal(scale=0.3, size=(40, 3)), np.ones(40), np.ones(40)))
        for _ in poses
    ]
    problem = SubjectProblem(shape, start, clouds, poses)
    x = problem.start + 1e-3 * random.normal(size=len(problem.start))
    value, gradient, matrix = problem.normal_equations(x)
    assert value == problem.value_and_gradient(x)[0]
    assert np.linalg.eigvalsh(matrix).min() > -1e-6 * np.abs(matrix).max()
    step = 1e-6
    numeric = [
        (problem.value_and_gradient(x + way)[0] - problem.value_and_gradient(x - way)[0])
        / (2.0 * step)
        for way in step * np.eye(len(x))
    ]
    np.testing.assert_allclose(gradient, numeric, rtol=1e-3, atol=1e-3 * np.abs(gradient).max())


# Finding proportions.


def test_noise_along_the_rays_takes_no_side(random):
    body = HUMAN.body("human", 1.7)
    pose = posed(body, STANCES[0])
    noise = 0.02 * random.normal(size=CAMERA.width * CAMERA.height)
    capsules = body.capsules.place(body.place(pose).transforms)
    distances = Cloud.of(seen(body, pose, noise)).data_to_model(capsules, 0.1).lengths
    assert abs(distances.mean()) < 1.5e-3


def test_hidden_parts_are_not_missed():
    body = HUMAN.body("human", 1.7)
    pose = posed(body, {"left_upper_arm": [60, 0, 0], "left_forearm": 90})
    capsules = body.capsules.place(body.place(pose).transforms)
    cloud = Cloud.of(seen(body, pose))
    distances, weights = cloud.model_to_data(capsules)
    assert (weights == 0.0).any()
    blind = Cloud.of(Observation(*[getattr(cloud.observation, n) for n in
                                   ("points", "weights", "variances")]))  # fmt: skip
    everywhere, even = blind.model_to_data(capsules)
    assert weights @ distances.lengths < 0.5 * even @ everywhere.lengths


@pytest.mark.long
def test_known_proportions_are_found(random):
    shape = Shape(HUMAN)
    truth = unlike(shape, random)
    body = shape.body(truth)
    poses = [posed(body, stance) for stance in STANCES]
    pixels = CAMERA.width * CAMERA.height
    clouds = [Cloud.of(seen(body, pose, 0.005 * random.normal(size=pixels))) for pose in poses]
    start = x = shape.origin(1.6)
    starts = [transformed(body, pose, random, 0.04) for pose in poses]
    for _ in range(2):
        problem = SubjectProblem(shape, x, clouds, starts)
        with one_blas_thread():
            solution = GaussNewton(max_iterations=30).minimize(problem)
        x, starts = problem.shape(solution.x), problem.poses(solution.x)
    found = shape.description(x)
    right = shape.description(truth)
    assert found.size.value == pytest.approx(right.size.value, rel=0.015)
    one, other = (shape.proportions(numbers) for numbers in (x, truth))
    np.testing.assert_allclose(one.lengths, other.lengths, rtol=0.04)
    np.testing.assert_allclose(one.girths, other.girths, rtol=0.06)
    before = np.abs(shape.proportions(start).lengths / other.lengths - 1.0).mean()
    assert np.abs(one.lengths / other.lengths - 1.0).mean() < 0.4 * before


def test_noise_makes_a_body_neither_thinner_nor_thicker(random):
    shape = Shape(HUMAN)
    size = HUMAN.size.value
    body = HUMAN.body("human", size)
    poses = [posed(body, stance) for stance in STANCES]
    noise = 0.02 * random.normal(size=(len(poses), CAMERA.width * CAMERA.height))
    clouds = [Cloud.of(seen(body, pose, one)) for pose, one in zip(poses, noise, strict=True)]
    problem = SubjectProblem(shape, shape.origin(size), clouds, poses)
    with one_blas_thread():
        solution = GaussNewton(max_iterations=20).minimize(problem)
    girths = shape.proportions(problem.shape(solution.x)).girths
    assert girths.mean() == pytest.approx(1.0, abs=0.015)


def test_of_each_part_of_a_track_the_best_explained_frame_is_taken():
    body = HUMAN.body("human", 1.7)
    explained = [0.5, 0.7, 0.6, np.nan, 0.9, 0.8]
    track = [
        TrackedFrame(
            Observation(np.full((1, 3), float(index)), np.ones(1), np.ones(1)),
            RegistrationResult(
                body.skeleton.rest(rigid(np.eye(3), np.array([float(index), 0.0, 0.0]))),
                0.0, share, True, 1, 1, "",
            ),
            0.0,
            0.0,
        )
        for index, share in enumerate(explained)
    ]  # fmt: skip
    looks = spread(iter(track), len(track), 3)
    assert [pose.root[0, 3] for pose in looks.poses] == [1.0, 2.0, 4.0]
    assert looks.first.root[0, 3] == 0.0
    assert len(spread(iter(track), len(track), 99).poses) == len(track)


def test_a_body_that_was_not_found_is_refused():
    shape = ProportionShape(HUMAN)
    x = shape.origin(1.7)
    check(shape, x, 0.01)
    with pytest.raises(NotFoundError, match=r"lies 5.0 cm from the data: the body was not found"):
        check(shape, x, 0.05)
    x[1 + Groups.of(HUMAN).names.index("shin")] = 0.4
    with pytest.raises(NotFoundError, match=r"'shin' came out 1.49 times as long"):
        check(shape, x, 0.01)
    with pytest.raises(NotFoundError, match=r"6\.49 m, and the template's range"):
        check(shape, shape.origin(6.49), 0.01)


@pytest.mark.parametrize(("off", "size"), [(0.03, 1.7), (0.01, 0.19)])
def test_a_surface_far_from_the_data_is_refused_and_noise_is_not(off, size):
    check_distance(0.004, size)
    with pytest.raises(NotFoundError, match="from the data"):
        check_distance(off, size)


def test_a_shape_that_hardly_anyone_has_is_refused():
    shape = ModeShape(HUMAN)
    x = shape.origin(1.7)
    check(shape, x, 0.01)
    x[:20] = shape.shape.bounds[:20, 1]
    with pytest.raises(NotFoundError, match="standard deviations from the mean"):
        shape.check(x)


def test_points_are_averaged_to_suit_the_body():
    voxels = [
        Calibration(template=template)._preprocessor().voxel
        for template in ("human", {"kind": "human", "height": 1.0}, "hand")
    ]
    assert voxels[0] == pytest.approx(0.03, abs=2e-3)
    assert voxels[1:] == pytest.approx([0.018, 0.01])
