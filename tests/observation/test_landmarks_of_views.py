"""Landmarks of several cameras: in the world, each where it is known best."""

from dataclasses import replace

import numpy as np
import pytest
from lamp import LAMP
from ruamel.yaml import YAML

from regkit.body import BodyDescription
from regkit.geometry.rigid import inverse, rigid, transformed
from regkit.geometry.rotation import vector_to_matrix
from regkit.interfaces import Method
from regkit.observation import Frame, Landmarks, View
from regkit.skeleton import PoseDescription
from regkit.system.errors import ConfigError
from regkit_plugins.preprocessors.points import PointsPreprocessor

SIDE = rigid(vector_to_matrix(np.array([0.1, 1.2, -0.2])), np.array([0.5, -0.3, 2.0]))
FRONT = np.eye(4)


def seen(points: np.ndarray, T_world_camera: np.ndarray, landmarks: Landmarks | None = None):
    local = transformed(inverse(T_world_camera), points)
    return View("camera", T_world_camera, Frame(local, landmarks=landmarks))


def test_landmarks_are_in_the_world_and_those_of_the_surest_camera(random) -> None:
    points, places = random.normal(size=(50, 3)), random.normal(size=(2, 3))
    local = transformed(inverse(SIDE), places)
    sure = Landmarks.in_space(("head", "toe"), local, np.array([0.9, 0.2]))
    other = Landmarks.in_space(("toe", "hand"), random.normal(size=(2, 3)), np.array([0.5, 1.0]))
    found = Frame.of_views([seen(points, SIDE, sure), seen(points, FRONT, other)]).landmarks
    assert found is not None
    assert set(found.names) == {"head", "toe", "hand"}
    np.testing.assert_allclose(found.positions[found.rows["head"]], places[0], atol=1e-9)
    np.testing.assert_allclose(found.positions[found.rows["toe"]], other.positions[0])


def test_landmarks_in_the_picture_alone_are_refused(random) -> None:
    flat = Landmarks.in_picture(("head",), np.array([[10.0, 20.0]]))
    points = random.normal(size=(50, 3))
    with pytest.raises(ConfigError, match="'head' is known in the picture alone"):
        Frame.of_views([seen(points, SIDE, flat), seen(points, FRONT, flat)])


@pytest.mark.parametrize("compiled", [True, False])
def test_landmarks_pull_a_body_that_several_cameras_see(random, compiled) -> None:
    body = BodyDescription.model_validate(YAML(typ="safe").load(LAMP)).body("lamp", 1.0)
    truth = body.skeleton.pose(PoseDescription(joints={"arm": 30.0, "head": -80.0}))
    start = body.skeleton.pose(PoseDescription(joints={"arm": -20.0, "head": -20.0}))
    markers = body.markers.place(body.place(truth).transforms)
    frame = Frame.of_views([seen(markers.repeat(20, axis=0), pose) for pose in (SIDE, FRONT)])
    frame = replace(frame, landmarks=Landmarks.in_space(body.markers.names, markers))
    observation = PointsPreprocessor(voxel=0.01, sigma=0.02).observation(frame)
    landmarks = {"kind": "landmarks", "weight": 1000.0}
    method = Method.parse(
        {"preset": "spheres", "compiled": compiled, "terms": [landmarks]},
        place="test",
        field="method",
    )
    found = method.bind(body).register(observation, [start]).pose
    placed = body.markers.place(body.place(found).transforms)
    assert np.linalg.norm(placed - markers, axis=1).max() < 0.05
