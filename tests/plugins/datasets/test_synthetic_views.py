"""Takes of the dataset ``synthetic`` that several cameras see."""

import numpy as np
import pytest

from regkit.geometry.rigid import inverse, transformed
from regkit.system.errors import ConfigError
from regkit_plugins.datasets.synthetic import Synthetic

CAMERA = {"width": 44, "height": 36, "fx": 45}
VIEWS = [
    {"heading_deg": 30, "place": [0.0, 0.76, 3.1]},
    {"heading_deg": 120},
    {"heading_deg": -120, "elevation_deg": 20},
]
TAKE = {"motion": "walk", "frames": 2, "noise": 0.01}


@pytest.fixture(scope="module")
def recordings():
    """The take as one camera and as three cameras see it."""
    takes = {"walk": {**TAKE, "view": VIEWS[0]}}
    (one,) = Synthetic(camera=CAMERA, takes=takes).found()
    (three,) = Synthetic(camera=CAMERA, takes={"walk": {**TAKE, "views": VIEWS}}).found()
    return one, three


def test_first_of_several_cameras_sees_what_one_alone_sees(recordings):
    one, three = recordings
    assert one.cameras() == {}
    for alone, frame in zip(one.frames(), three.frames(), strict=True):
        first = frame.views[0]
        np.testing.assert_array_equal(first.data.depth, alone.depth)
        np.testing.assert_array_equal(first.T_world_camera, np.eye(4))
    np.testing.assert_array_equal(one.truth().positions, three.truth().positions)
    assert one.fingerprint() != three.fingerprint()


def test_cameras_see_the_same_joints_from_their_poses(recordings):
    _, three = recordings
    truth = three.truth().positions
    for pose, recording in zip(
        three.camera_poses().values(), three.cameras().values(), strict=True
    ):
        seen = recording.truth().positions
        expected = transformed(inverse(pose), truth.reshape(-1, 3)).reshape(truth.shape)
        np.testing.assert_allclose(seen, expected, atol=1e-5)


def test_noise_differs_from_camera_to_camera():
    same = Synthetic(camera=CAMERA, takes={"walk": {**TAKE, "views": [VIEWS[0], VIEWS[0]]}})
    first, second = next(iter(same.found()[0].frames())).views
    assert (first.data.depth != second.data.depth).any()
    assert len(first.data.points) == pytest.approx(len(second.data.points), rel=0.05)


def test_take_has_a_view_or_views_and_the_defaults_give_way():
    with pytest.raises((ConfigError, ValueError), match="not both"):
        Synthetic(camera=CAMERA, takes={"walk": {**TAKE, "view": VIEWS[0], "views": VIEWS}})
    data = {
        "camera": CAMERA,
        "defaults": {"view": VIEWS[0]},
        "takes": {"walk": {**TAKE, "views": VIEWS}},
    }
    assert Synthetic.model_validate(data).takes["walk"].views is not None
