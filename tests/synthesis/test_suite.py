"""The bodies of the evaluation suite stay in the image, move as bodies do, and have templates."""

from __future__ import annotations

from dataclasses import replace
from functools import cache

import numpy as np
import pytest

from regkit.body import BodyDescription, ellipsoids
from regkit.config.document import Document
from regkit.geometry.rotation import vector_to_matrix
from regkit_plugins.templates.reading import FOLDER
from regkit_synthesis.recordings.scene import FPS, SR305, SR4000
from regkit_synthesis.recordings.suite import SUITE

RECORDINGS = [(name, take) for name, body in SUITE.items() for take in body.takes]
PEOPLE = [pair for pair in RECORDINGS if pair[0].startswith("human")]

SHIPPED = {"human_average": "human.yaml", "hand_average": "hand_right.yaml"}

BONES = {
    "human": [
        ("left_shoulder", "left_elbow"),
        ("left_elbow", "left_wrist"),
        ("right_hip", "right_knee"),
        ("right_knee", "right_ankle"),
        ("right_ankle", "right_foot"),
        ("left_hip", "right_hip"),
    ],
    "hand": [
        ("wrist", "index_mcp"),
        ("index_mcp", "little_mcp"),
        ("thumb_cmc", "thumb_mcp"),
        ("thumb_ip", "thumb_tip"),
        ("middle_mcp", "middle_pip"),
        ("middle_pip", "middle_dip"),
        ("ring_dip", "ring_tip"),
    ],
}
"""Some rigid bones: pairs of joints whose distance never changes."""


@cache
def _scene(name, take):
    body = SUITE[name]
    return body.takes[take].scene(take, body.what, body.mesh())


@cache
def _joints(name, take):
    """Where each joint is in every image (T, 3), by its name."""
    scene = _scene(name, take)
    return dict(zip(scene.landmarks, np.moveaxis(scene.truth(), 1, 0), strict=True))


def test_suite_has_the_bodies_and_enough_recordings():
    assert list(SUITE) == ["human_average", "human_small", "hand_average", "hand_slim"]
    assert [len(body.takes) for body in SUITE.values()] == [7, 6, 3, 3]


@pytest.mark.parametrize(("name", "take"), RECORDINGS)
def test_length_is_that_of_an_evaluation(name, take):
    assert 60 <= _scene(name, take).frames <= 90


@pytest.mark.parametrize(("name", "take"), RECORDINGS)
def test_whole_body_stays_in_the_image(name, take):
    """Every vertex is seen from a camera that would be a pixel smaller on every side."""
    scene = _scene(name, take)
    camera = scene.sensor.camera
    for frame in range(0, scene.frames, 4):
        vertices = scene.mesh.posed(scene.bone_poses(frame / FPS))
        pixels = camera.projected(vertices)
        assert pixels.min() > 0.5
        assert (pixels.max(axis=0) < [camera.width - 1.5, camera.height - 1.5]).all()


@pytest.mark.parametrize(("name", "take"), PEOPLE)
def test_person_is_at_the_distance_and_shows_its_front(name, take):
    joints = _joints(name, take)
    assert 2.5 < joints["pelvis"][:, 2].mean() < 3.3
    across = joints["left_shoulder"] - joints["right_shoulder"]
    headings = np.degrees(np.arctan2(across[:, 2], across[:, 0]))
    assert np.abs(headings).max() < 95.0
    assert abs(headings[0]) < 65.0


@pytest.mark.parametrize(("name", "take"), [pair for pair in RECORDINGS if pair not in PEOPLE])
def test_hand_is_at_the_distance_and_begins_open(name, take):
    joints = _joints(name, take)
    assert np.abs(joints["middle_mcp"][:, 2] - 0.4).max() < 0.05
    reach = joints["middle_tip"] - joints["wrist"]
    assert reach[0] @ [0.0, -1.0, 0.0] > 0.13  # The fingers are stretched, and point up.
    across = joints["index_mcp"] - joints["little_mcp"]
    assert across[0, 0] > 0.9 * np.linalg.norm(across[0])  # The palm looks into the camera.


@pytest.mark.parametrize(("name", "take"), RECORDINGS)
def test_bones_keep_their_lengths(name, take):
    joints = _joints(name, take)
    for start, end in BONES[name.split("_")[0]]:
        assert np.ptp(np.linalg.norm(joints[end] - joints[start], axis=1)) < 1e-6


@pytest.mark.parametrize(("name", "take"), RECORDINGS)
def test_motion_is_continuous(name, take):
    truth = np.stack(list(_joints(name, take).values()), axis=1)
    steps = np.diff(truth, axis=0)
    speed = 2.0 if take in ("punch_fast", "walk_fast") else 1.0
    fastest, jerkiest = (0.25, 0.18) if name.startswith("human") else (0.035, 0.015)
    assert np.linalg.norm(steps, axis=-1).max() < speed * fastest
    assert np.linalg.norm(np.diff(steps, axis=0), axis=-1).max() < speed * jerkiest


def test_names_say_what_is_seen():
    human, small = SUITE["human_average"].takes, SUITE["human_small"].takes
    assert {human["dance_noisy"].noise, small["walk_noisy"].noise, small["kick_noisy"].noise} == {
        0.02
    }
    assert human["walk_oblique"].heading == 60.0
    assert small["walk_above"].tilt == 20.0
    assert human["punch_fast"].speed == small["walk_fast"].speed == 2.0
    for name, take in RECORDINGS:
        sensor = _scene(name, take).sensor
        usual = SR4000 if name.startswith("human") else SR305
        assert sensor.camera == usual.camera
        assert sensor.noise == (0.02 if take.endswith("_noisy") else usual.noise)


def test_camera_from_above_is_a_metre_higher_and_looks_down():
    body = SUITE["human_small"]
    above, level = body.takes["walk_above"], body.takes["walk_noisy"]
    assert above.place[1] == pytest.approx(level.place[1] + 1.0)
    seen_level = replace(above, tilt=0.0).scene("level", body.what, body.mesh()).truth()
    turn = vector_to_matrix(np.radians([20.0, 0.0, 0.0]))
    assert np.allclose(_scene("human_small", "walk_above").truth(), seen_level @ turn.T)
    joints = _joints("human_small", "walk_above")
    assert (joints["head"][:, 2] < joints["pelvis"][:, 2] - 0.1).all()


@pytest.fixture(scope="module", params=list(SUITE))
def fitted(request, tmp_path_factory):
    """A body of the suite, and the template that is fitted to it."""
    body = SUITE[request.param]
    path = tmp_path_factory.mktemp("suite") / f"{request.param}.yaml"
    body.template(body.mesh()).write(path)
    return request.param, Document.read(path).validated(BodyDescription)


def _at_rest(body):
    return body.markers.place(body.place(body.skeleton.rest()).transforms)


@pytest.mark.slow
def test_template_has_the_bones_of_the_mesh(fitted):
    name, description = fitted
    body = description.body(name, description.size.value)
    rest = dict(zip(body.markers.names, _at_rest(body), strict=True))
    joints = _joints(name, next(iter(SUITE[name].takes)))
    for start, end in BONES[name.split("_")[0]]:
        true = np.linalg.norm(joints[end] - joints[start], axis=1)
        assert np.linalg.norm(rest[end] - rest[start]) == pytest.approx(true, abs=0.002)


@pytest.mark.slow
@pytest.mark.parametrize("fitted", SHIPPED, indirect=True)
def test_template_of_the_average_is_the_shipped_one(fitted):
    name, description = fitted
    shipped = Document.read(FOLDER / SHIPPED[name]).validated(BodyDescription)
    assert (description.title, description.sources) == (shipped.title, shipped.sources)
    own, other = (one.body(name, one.size.value) for one in (description, shipped))
    for kind in ("sog", "gsog"):
        np.testing.assert_allclose(
            *(ellipsoids(one.shapes[kind])[1] for one in (own, other)), atol=1e-3
        )
    np.testing.assert_allclose(_at_rest(own), _at_rest(other), atol=1e-3)
