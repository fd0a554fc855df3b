"""Searches for the first pose, found from a cloud alone, and given poses."""

from pathlib import Path

import numpy as np
import pytest
from messages import tells
from places import EXAMPLES

from regkit.body import Body
from regkit.experiment import Experiment
from regkit.geometry.camera import Camera
from regkit.geometry.rigid import rigid
from regkit.geometry.rotation import vector_to_matrix
from regkit.interfaces import Start, StartSearch
from regkit.metrics import matched
from regkit.observation import Frame, Observation
from regkit.skeleton import Pose, PoseDescription
from regkit.system.errors import ConfigError
from regkit.system.optional import one_blas_thread
from regkit_plugins.preprocessors.points import PointsPreprocessor
from regkit_plugins.starts.exemplars import Exemplars
from regkit_plugins.starts.given import Given
from regkit_plugins.starts.stances import Stances
from regkit_plugins.templates.file import FileTemplate

CAMERA = Camera(width=96, height=80, fx=110.0, fy=110.0, cx=47.5, cy=39.5)

LAMP = """
title: A desk lamp, no two parts of which are alike.
size: {name: height, value: 1.0, range: [0.8, 1.25]}
upright: true
segments:
  foot:
    joint: {type: free}
    capsules:
      - {start: [-0.15, 0, 0], end: [0.25, 0, 0], radius: [0.08, 0.05]}
    markers: {heel: [-0.15, 0, 0], toe: [0.25, 0, 0]}
  arm:
    parent: foot
    offset: [0, 0.05, 0]
    joint: {type: hinge, axis: z, limits_deg: [-60, 60]}
    capsules: [{start: [0, 0, 0], end: [0, 0.5, 0], radius: [0.04, 0.05]}]
    markers: {elbow: [0, 0.5, 0]}
  head:
    parent: arm
    offset: [0, 0.5, 0]
    joint: {type: hinge, axis: z, limits_deg: [-120, 0]}
    capsules: [{start: [0, 0, 0], end: [0, 0.35, 0], radius: [0.04, 0.1]}]
    markers: {bulb: [0, 0.35, 0]}
stances:
  bowed: {joints: {head: -60}}
"""


def seen(body: Body, pose: Pose) -> Observation:
    """What a depth camera sees of a body: along each ray, steps as long as the surface is far."""
    surface = body.capsules.place(body.place(pose).transforms)
    rays = CAMERA.rays().reshape(-1, 3)
    rays = rays / np.linalg.norm(rays, axis=1, keepdims=True)
    along = np.full(len(rays), 0.5)
    for _ in range(60):
        along += surface.surface_distance(along[:, None] * rays)
        along = np.minimum(along, 10.0)
    points = along[:, None] * rays
    hit = np.abs(surface.surface_distance(points)) < 1e-3
    return PointsPreprocessor(sigma=0.02).preprocess(Frame(points[hit], CAMERA))


def facing(body: Body, turn: float, joints: dict[str, float]) -> Pose:
    """The body 2.5 m before the camera, turned about the upright [rad]."""
    bones = body.skeleton
    pose = bones.pose(PoseDescription(joints=joints))
    rotation = np.diag([1.0, -1.0, -1.0]) @ vector_to_matrix(np.array([0.0, turn, 0.0]))
    root = rigid(rotation, np.array([0.1, 0.35, 2.5]))
    return Pose(root, pose.balls, pose.hinges)


def markers(start: Start) -> np.ndarray:
    return start.body.markers.place(start.body.place(start.pose).transforms)


@pytest.fixture
def lamp(tmp_path) -> Path:
    path = tmp_path / "lamp.yaml"
    path.write_text(LAMP)
    return path


@pytest.fixture(params=[Stances(), Exemplars(exemplars=3000)], ids=lambda search: search.kind)
def search(request) -> StartSearch:
    return request.param


@pytest.mark.parametrize("turn", [-0.3, 0.0, 0.25])
@pytest.mark.parametrize("joints", [{}, {"arm": 20.0, "head": -75.0}, {"arm": -25.0}])
def test_start_of_a_seen_body_is_found(search, lamp, turn, joints):
    template = FileTemplate(path=lamp, size=1.0)
    body = template.body(1.0)
    pose = facing(body, turn, joints)
    found = search.find(template, [seen(body, pose)])
    assert found.body.size == 1.0
    expected = body.markers.place(body.place(pose).transforms)
    assert np.linalg.norm(markers(found) - expected, axis=1).max() < 0.05
    assert found.body.skeleton.limits.violation(found.pose).max() < 1e-6


@pytest.mark.parametrize("size", [0.8, 1.0, 1.25])
def test_start_finds_the_size_too(search, lamp, size):
    template = FileTemplate(path=lamp)
    body = template.body(size)
    pose = facing(body, 0.1, {"arm": 10.0, "head": -40.0})
    found = search.find(template, [seen(body, pose)])
    assert found.body.size == pytest.approx(size, rel=0.13)
    expected = body.markers.place(body.place(pose).transforms)
    assert np.linalg.norm(markers(found) - expected, axis=1).max() < 0.08


def test_start_is_the_same_again(search, lamp):
    template = FileTemplate(path=lamp, size=1.0)
    observation = seen(template.body(1.0), facing(template.body(1.0), 0.2, {"head": -50.0}))
    first, second = (search.find(template, [observation]) for _ in range(2))
    np.testing.assert_array_equal(first.pose.root, second.pose.root)
    np.testing.assert_array_equal(first.pose.hinges, second.pose.hinges)


def test_given_start_is_taken_as_it_is(lamp):
    given = Given.model_validate(
        {"root": {"position": [1, 2, 3], "rotation_deg": [180, 0, 0]}, "joints": {"arm": 30}}
    )
    start = given.find(FileTemplate(path=lamp, size=0.9), [])
    assert start.body.size == 0.9
    np.testing.assert_array_equal(start.pose.root[:3, 3], [1, 2, 3])
    np.testing.assert_allclose(start.pose.root[:3, :3], np.diag([1, -1, -1]), atol=1e-12)
    np.testing.assert_allclose(start.pose.hinges, np.radians([30.0, 0.0]))


def test_given_start_without_a_size_is_refused(lamp):
    with pytest.raises(ConfigError) as caught:
        Given().check(FileTemplate(path=lamp))
    assert tells(str(caught.value), at="", of=("start", "template's size"))


def test_given_start_of_an_unknown_joint_is_refused(lamp):
    given = Given(joints={"leg": 10.0})
    with pytest.raises(ConfigError, match="'leg'"):
        given.check(FileTemplate(path=lamp, size=1.0))


@pytest.mark.parametrize(("name", "worst_cm"), [("demo", 4.0), ("hand", 2.5)])
def test_start_of_the_samples_is_near_the_truth(search, name, worst_cm):
    """The mean over the joints of the first frame, of a body whose size is not told."""
    experiment = Experiment.read(EXAMPLES / f"{name}.yaml", ["dataset.frames=1"])
    assert experiment.template.given_size() is None
    (recording,) = experiment.dataset.chosen()
    observation = experiment.preprocessor.preprocess(next(recording.frames()))
    with one_blas_thread():
        found = search.find(experiment.template, [observation])
    truth = recording.truth()
    columns, rows = matched(found.body, truth, experiment.dataset.joints)
    errors = np.linalg.norm(truth.positions[0, columns] - markers(found)[rows], axis=1)
    assert len(errors) >= 20
    assert 100.0 * errors.mean() < worst_cm


def test_template_without_capsules_or_free_root_has_no_start(search, lamp, tmp_path):
    fixed = tmp_path / "fixed.yaml"
    fixed.write_text(lamp.read_text().replace("type: free", "type: fixed"))
    with pytest.raises(ConfigError, match="has no free root"):
        search.find(FileTemplate(path=fixed), [Observation(np.eye(3), np.ones(3), np.ones(3))])
