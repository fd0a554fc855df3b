"""The base of a robot that stands still: one pose for all frames."""

import json

import numpy as np
import pytest
from lamp import CAMERA, LAMP, facing, seen
from messages import tells
from PIL import Image

from regkit.body.verdict import Verdict
from regkit.calibration.base.found import FoundBase
from regkit.calibration.base.problem import BaseProblem
from regkit.calibration.base.solution import solved
from regkit.geometry.rigid import exp, inverse, log
from regkit.geometry.rotation import from_matrix, to_vector
from regkit.interfaces import Method, Solver
from regkit.observation import Observation, View
from regkit.skeleton import Pose
from regkit_plugins.templates.file import FileTemplate

JOINTS = [{"arm": angle, "head": -60.0 - angle} for angle in (-25.0, -5.0, 15.0, 30.0)]


@pytest.fixture
def lamp(tmp_path):
    path = tmp_path / "lamp.yaml"
    path.write_text(LAMP)
    return FileTemplate(path=path, size=1.0)


@pytest.fixture
def registrar(lamp):
    return Method.parse("spheres", place="test", field="method").bind(lamp.body(1.0))


def standing(body):
    return [facing(body, 0.3, joints) for joints in JOINTS]


def displaced(body, poses, seed=0):
    """The poses as a track has them: each with another base, and other joints."""
    random = np.random.default_rng(seed)
    return [
        body.skeleton.limits.projected(
            body.skeleton.retract(pose, 0.03 * random.standard_normal(body.skeleton.dofs))
        )
        for pose in poses
    ]


def solver():
    return Solver.parse(Solver.default(max_iterations=12), place="test", field="solver")


@pytest.mark.long
def test_frames_with_displaced_bases_have_their_common_one(registrar):
    body = registrar.body
    poses = standing(body)
    frames = [seen(body, pose, image=True) for pose in poses]
    found = solved(registrar, frames, displaced(body, poses), solver())
    error = log(inverse(poses[0].root) @ found.T_world_base)
    assert np.linalg.norm(error[:3]) < 0.004
    assert np.degrees(np.linalg.norm(error[3:])) < 0.5
    for pose, truth in zip(found.poses, poses, strict=True):
        np.testing.assert_array_equal(pose.root, found.T_world_base)
        assert np.degrees(np.abs(pose.hinges - truth.hinges)).max() < 1.5
    assert found.verdict is Verdict.FOUND
    assert np.linalg.eigvalsh(found.covariance).min() > 0.0


def test_base_that_moves_is_doubtful(registrar):
    body = registrar.body
    steps = np.zeros((len(JOINTS), body.skeleton.dofs))
    steps[:, 0] = [-0.15, -0.1, 0.1, 0.15]
    poses = [body.skeleton.retract(pose, step)
             for pose, step in zip(standing(body), steps, strict=True)]  # fmt: skip
    frames = [seen(body, pose, image=True) for pose in poses]
    found = solved(registrar, frames, poses, solver())
    assert found.verdict is Verdict.DOUBTFUL
    assert "may not stand still" in found.reason


def test_base_is_known_better_from_two_sides(registrar):
    body = registrar.body
    pose = standing(body)[0]
    one = seen(body, pose, image=True)
    turned = exp(np.array([0.0, 0.0, 0.0, 0.0, 1.5, 0.0]))
    T_world_other = pose.root @ turned @ inverse(pose.root)
    other = seen(body, pose.moved(inverse(T_world_other)), image=True)
    both = Observation.of_views([View("a", np.eye(4), one), View("b", T_world_other, other)])
    alone, together = (
        BaseProblem(registrar, [frame], [pose], pose.root, np.array([50.0])).covariance(np.zeros(8))
        for frame in (one, both)
    )
    assert np.linalg.eigvalsh(together).max() < np.linalg.eigvalsh(alone).max()


def test_gradient_is_the_derivative_of_the_sum(registrar):
    """The energy rebinds at each pose, so that only its smooth part is compared."""
    body = registrar.body
    poses = standing(body)[:2]
    frames = [seen(body, pose) for pose in poses]
    base = poses[0].root @ exp(np.array([0.02, -0.01, 0.015, 0.03, -0.02, 0.04]))
    problem = BaseProblem(registrar, frames, poses, base, np.array([30.0, 70.0]))
    x = 0.02 * np.random.default_rng(1).standard_normal(len(problem.start))
    _, gradient = problem.value_and_gradient(x)
    step = 1e-3
    differences = [
        (problem.value_and_gradient(x + step * unit)[0]
         - problem.value_and_gradient(x - step * unit)[0]) / (2.0 * step)
        for unit in np.eye(len(x))
    ]  # fmt: skip
    np.testing.assert_allclose(gradient, differences, atol=0.05 * np.abs(gradient).max())


def found_at(body, T_world_base, covariance, T_world_camera):
    return FoundBase(
        body, T_world_base, covariance, {"side": T_world_camera}, [], 0.0, Verdict.FOUND
    )


def test_covariance_follows_the_camera_into_the_frame_of_the_base(lamp):
    body = lamp.body(1.0)
    random = np.random.default_rng(3)
    T_world_base, T_world_camera = exp(random.normal(size=(2, 6)))
    root = random.normal(size=(6, 6))
    covariance = root @ root.T
    found = found_at(body, T_world_base, covariance, T_world_camera).in_base("side")
    rest = body.skeleton.rest()
    columns = []
    for direction in 1e-6 * np.eye(6):
        step = np.concatenate([direction, np.zeros(body.skeleton.dofs - 6)])
        moved = body.skeleton.retract(Pose(T_world_base, rest.balls, rest.hinges), step).root
        T_base_camera = inverse(moved) @ T_world_camera
        turn = found.T_base_camera[:3, :3].T @ T_base_camera[:3, :3]
        shift = T_base_camera[:3, 3] - found.T_base_camera[:3, 3]
        columns.append(np.concatenate([shift, to_vector(from_matrix(turn))]) / 1e-6)
    jacobian = np.array(columns).T
    expected = jacobian @ covariance @ jacobian.T
    np.testing.assert_allclose(found.covariance, expected, rtol=1e-4, atol=1e-4)


def test_other_axes_turn_the_base_and_not_the_camera(lamp):
    random = np.random.default_rng(4)
    T_world_base, T_world_camera = exp(random.normal(size=(2, 6)))
    root = random.normal(size=(6, 6))
    found = found_at(lamp.body(1.0), T_world_base, root @ root.T, T_world_camera).in_base("side")
    turn = exp(np.array([0.0, 0.0, 0.0, 0.3, -0.7, 1.1]))[:3, :3]
    other = found.in_axes(turn)
    np.testing.assert_allclose(other.T_base_camera[:3], turn @ found.T_base_camera[:3])
    spread = turn @ found.covariance[:3, :3] @ turn.T
    np.testing.assert_allclose(other.covariance[:3, :3], spread)
    np.testing.assert_allclose(other.covariance[3:, 3:], found.covariance[3:, 3:])


@pytest.fixture
def recording(lamp, tmp_path):
    """The folder of a recording of a lamp that stands still, and where it stands."""
    body = lamp.body(1.0)
    poses = standing(body)
    root = tmp_path / "standing"
    (root / "depth").mkdir(parents=True)
    (root / "sequence.yaml").write_text("fps: 10\n")
    (root / "camera.json").write_text(CAMERA.to_json())
    for frame, pose in enumerate(poses):
        depth = np.rint(1000.0 * seen(body, pose, image=True).depth).astype(np.uint16)
        Image.fromarray(depth).save(root / "depth" / f"{frame:06d}.png")
    return root, poses[0].root


def test_calibrate_writes_a_robot_that_stands_and_its_camera(recording, tmp_path, regkit):
    root, T_camera_base = recording
    experiment = tmp_path / "experiment.yaml"
    experiment.write_text(
        f"name: lamp\ndataset: {{kind: depth, root: {root}}}\n"
        "template: {kind: file, path: lamp.yaml, size: 1.0}\n"
        "start: {kind: exemplars, exemplars: 3000}\nsegmentation: []\n"
        "methods: {best: {preset: best}}\n"
        "preprocessor: {kind: points, voxel: 0.03, sigma: 0.01}\n"
    )
    out = tmp_path / "standing.yaml"
    ended = regkit("calibrate", experiment, "--base", "--out", out)
    assert ended.code == 0, ended.err
    record = json.loads((tmp_path / "standing_cameras.json").read_text())
    (camera,) = record["cameras"]
    error = log(T_camera_base @ np.array(camera["T_base_camera"]))
    assert np.linalg.norm(error[:3]) < 0.05
    assert np.degrees(np.linalg.norm(error[3:])) < 4.0
    assert np.shape(camera["covariance"]) == (6, 6)
    assert regkit("validate", out).code == 0
    body = FileTemplate(path=out, size=1.0).body(1.0)
    foot = body.place(body.skeleton.rest()).transforms[0]
    np.testing.assert_allclose(foot @ np.array(camera["T_base_camera"]), np.eye(4), atol=1e-4)
    # The base of a robot that stands already is not sought.
    again = regkit("calibrate", root, "--base", "--template", out, "--out", tmp_path / "again.yaml")
    assert again.code == 1
    assert "fixed already" in again.err


def test_calibrate_of_a_base_names_the_options_that_it_cannot_take(recording, regkit):
    root, _ = recording
    for options, at, of in (
        (["--base", "--extrinsics"], "--extrinsics", "--base"),
        (["--up", "z"], "--up", "--base"),
        (["--base", "--up", "w", "--template", "hand"], "--up", "'w'"),
    ):
        ended = regkit("calibrate", root, *options)
        assert ended.code == 1
        assert tells(ended.err, at=at, of=of), ended.err
