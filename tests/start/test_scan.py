"""The distance of a cloud and a body on both sides."""

import numpy as np
import pytest
from lamp import CAMERA, LAMP, facing, seen

from regkit.body import Body
from regkit.observation import Silhouette
from regkit.start import Scan
from regkit_plugins.templates.file import FileTemplate


@pytest.fixture
def body(tmp_path) -> Body:
    path = tmp_path / "lamp.yaml"
    path.write_text(LAMP)
    return FileTemplate(path=path, size=1.0).body(1.0)


def test_body_beyond_the_border_costs_nothing(body):
    """What the camera shows of a lamp fits it as well with its foot below the picture."""
    pose = facing(body, 0.2, {"arm": 10.0, "head": -60.0})
    pose.root[1, 3] = 1.05
    observation, placement = seen(body, pose, image=True), body.place(pose)
    known, unknown = Scan.of(observation), Scan(observation.points)
    assert known.distances(body, placement)[1].lengths.max() < 0.03
    assert known.misfit(body, placement, 0.1) < 0.15
    assert unknown.misfit(body, placement, 0.1) > known.misfit(body, placement, 0.1) + 0.2


def test_body_on_unknown_pixels_costs_nothing(body):
    pose = facing(body, 0.0, {})
    observation, placement = seen(body, pose, image=True), body.place(pose)
    image = observation.depth.copy()
    image[CAMERA.height // 2 :] = np.nan
    above = observation.points[observation.points[:, 1] < 0.0]
    masked = Scan(above, Silhouette(CAMERA, image))
    assert masked.misfit(body, placement, 0.1) < Scan(above).misfit(body, placement, 0.1) - 0.2


def test_body_in_free_space_costs_its_distance(body):
    pose = facing(body, 0.0, {})
    scan = Scan.of(seen(body, pose, image=True))
    pose.root[0, 3] -= 0.4
    assert scan.distances(body, body.place(pose))[1].lengths.mean() > 0.1
