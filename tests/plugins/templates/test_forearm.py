"""The forearm of a hand explains data behind the wrist, and costs nothing where there are none."""

from __future__ import annotations

import numpy as np
import pytest

from regkit.body import BodyDescription
from regkit.body.fit import BodyFit
from regkit.body.writing import template_text
from regkit.geometry.camera import Camera
from regkit.interfaces import Template
from regkit.search.exemplars.blocks import grid_around
from regkit.search.exemplars.model import Spheres
from regkit.search.exemplars.rendering import disagreements
from regkit.skeleton import Pose
from regkit.start import Scan
from regkit_plugins.templates.hand import Hand, with_forearm

CAMERA = Camera(160, 120, 200.0, 200.0, 79.5, 59.5)
BEFORE = np.array([[1.0, 0, 0, 0], [0, -1, 0, 0], [0, 0, -1, 0.5], [0, 0, 0, 1]])


@pytest.fixture(scope="module")
def hands():
    return [Hand(length=0.19, forearm=part).body(0.19) for part in (False, True)]


def placed(body):
    rest = body.skeleton.rest()
    return Pose(BEFORE, rest.balls, rest.hinges)


def seen(body):
    """Returns the depth image of the body's surface, and its points."""
    axes = body.capsules.place(body.place(placed(body)).transforms).axis_points(0.003)
    rays = CAMERA.back_projected(np.ones((CAMERA.height, CAMERA.width)))
    along = rays @ axes.points.T / (rays**2).sum(axis=1)[:, None]
    square = (axes.points**2).sum(axis=1) - along**2 * (rays**2).sum(axis=1)[:, None]
    inside = np.maximum(axes.radii**2 - square, 0.0)
    depth = np.where(square < axes.radii**2, along - np.sqrt(inside), np.inf).min(axis=1)
    depth = np.where(np.isfinite(depth), depth, 0.0).reshape(CAMERA.height, CAMERA.width)
    return depth, CAMERA.back_projected(depth)


def disagreement(body, depth, points):
    spheres = Spheres.of(body, 0.005)
    links = body.place(placed(body)).links[None]
    grid = grid_around(CAMERA, depth, points)
    return disagreements(links, body.skeleton.segment_links, spheres, grid, 0.01)[0]


@pytest.mark.parametrize("side", ["right", "left"])
def test_forearm_leaves_the_hand_as_it_is(side):
    hand, longer = (Hand(side=side, length=0.19, forearm=part).body(0.19) for part in (False, True))
    assert set(longer.skeleton.names) == {*hand.skeleton.names, "forearm"}
    assert longer.markers.names == hand.markers.names
    np.testing.assert_array_equal(longer.required.ends, hand.capsules.ends)
    assert set(longer.shapes) == set(hand.shapes)


def test_forearm_joins_the_named_lists_of_the_hand():
    hand = Hand().description()
    shapes = {"gsog": hand.shapes["gsog"], "gsog/paper": hand.shapes["gsog"]}
    longer = with_forearm(hand.model_copy(update={"shapes": shapes}))
    assert set(longer.shapes) == {"gsog", "gsog/paper"}
    assert longer.shapes["gsog/paper"] == longer.shapes["gsog"]


def test_forearm_costs_nothing_where_there_are_no_data(hands):
    depth, points = seen(hands[0])
    with_it, without = hands[1], hands[0]
    alone = disagreement(without, depth, points)
    # It explains the wrist's own data as well as the palm does.
    assert disagreement(with_it, depth, points) == pytest.approx(alone, abs=1e-3)
    coverages = [BodyFit.of(one, placed(one), points).coverage for one in hands]
    assert coverages[1] == coverages[0] > 0.8
    sides = [Scan(points).distances(one, one.place(placed(one)))[1].lengths for one in hands]
    np.testing.assert_allclose(*sides, atol=1e-12)


def test_forearm_explains_data_behind_the_wrist(hands):
    depth, points = seen(hands[1])
    with_it, without = (disagreement(hands[part], depth, points) for part in (1, 0))
    assert with_it < 0.5 * without
    fits = [BodyFit.of(one, placed(one), points) for one in hands]
    assert fits[1].inlier_share == 1.0
    assert fits[0].inlier_share < 0.8


def test_written_template_keeps_its_optional_parts(tmp_path):
    description = Hand(forearm=True).description().model_copy(update={"mesh": None})
    file = tmp_path / "long.yaml"
    file.write_text(template_text(description, "A hand.", {}), encoding="utf-8")
    read = Template.parse(str(file), place="test", field="template").description()
    assert [name for name, one in read.segments.items() if one.optional] == ["forearm"]


def test_optional_root_is_refused():
    with pytest.raises(ValueError, match="the root cannot be optional"):
        BodyDescription.model_validate(
            {
                "title": "one",
                "size": {"name": "length", "value": 1, "range": [1, 1]},
                "segments": {"only": {"joint": {"type": "free"}, "optional": True}},
            }
        )
