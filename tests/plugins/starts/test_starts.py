"""Searches for the first pose, found from a cloud alone, and given poses."""

from pathlib import Path

import numpy as np
import pytest
from lamp import LAMP, facing, seen
from messages import tells
from places import EXAMPLES

from regkit.body.template_file import write_template
from regkit.calibration.base import at_base
from regkit.experiment import Experiment
from regkit.interfaces import Start, StartSearch
from regkit.metrics import matched
from regkit.observation import Observation
from regkit.system.errors import ConfigError
from regkit.system.optional import one_blas_thread
from regkit_plugins.starts.exemplars import Exemplars
from regkit_plugins.starts.given import Given
from regkit_plugins.starts.stances import Stances
from regkit_plugins.templates.file import FileTemplate


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


def test_start_of_a_body_that_the_border_cuts_off_is_found(lamp):
    """The foot is below the picture; arm and head are where they are seen."""
    template = FileTemplate(path=lamp, size=1.0)
    body = template.body(1.0)
    pose = facing(body, 0.2, {"arm": 10.0, "head": -60.0})
    pose.root[1, 3] = 1.05
    observation = seen(body, pose, image=True)
    expected = body.markers.place(body.place(pose).transforms)
    inside = observation.silhouette.observable(expected)
    assert inside.tolist() == [name in ("elbow", "bulb") for name in body.markers.names]
    found = Exemplars(exemplars=1000).find(template, [observation])
    assert np.linalg.norm(markers(found) - expected, axis=1)[inside].max() < 0.05


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


def test_template_without_capsules_has_no_start(search, lamp, tmp_path):
    bare = tmp_path / "bare.yaml"
    lines = [line for line in lamp.read_text().splitlines() if "start:" not in line]
    bare.write_text("\n".join(line for line in lines if line.strip() != "capsules:"))
    with pytest.raises(ConfigError, match="has no capsules"):
        search.find(FileTemplate(path=bare), [Observation(np.eye(3), np.ones(3), np.ones(3))])


def test_joints_are_found_of_a_body_whose_root_stands_still(search, lamp, tmp_path):
    joints = {"arm": 20.0, "head": -75.0}
    free = FileTemplate(path=lamp, size=1.0)
    body = free.body(1.0)
    pose = facing(body, 0.25, joints)
    standing = tmp_path / "standing.yaml"
    fixed = at_base(free.description(), pose.root, "test")
    write_template(standing, fixed, None, "A lamp that stands.")
    found = search.find(FileTemplate(path=standing, size=1.0), [seen(body, pose)])
    assert not found.body.skeleton.free
    expected = body.markers.place(body.place(pose).transforms)
    apart = np.linalg.norm(markers(found) - expected, axis=1)
    assert apart.max() < 0.05
    assert apart[:2].max() < 1e-4  # Those of the root, up to the decimals of a template.
