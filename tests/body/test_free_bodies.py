"""Bodies beside each other: alone and in the whole, and whose points are whose."""

import numpy as np
import pytest

from regkit.body import Body, BodyFit
from regkit.body.bones import bones_of
from regkit.body.each import gaps_to_each
from regkit.body.gaps import surface_gaps
from regkit.interfaces import Template
from regkit.skeleton import Pose


@pytest.fixture(scope="module")
def scene() -> Body:
    """A person with one articulated hand, and two hands beside."""
    template = {
        "kind": "composed",
        "base": "human",
        "at": {"left_hand": {"kind": "hand", "side": "left"}},
        "free": {"a": {"kind": "hand", "side": "left"}, "b": {"kind": "hand", "length": 0.17}},
    }
    return Template.parse(template, place="test", field="template").body(1.7)


def shaken(scene: Body, random: np.random.Generator) -> Pose:
    bones = scene.skeleton
    return bones.retract(bones.rest(), 0.3 * random.normal(size=bones.dofs))


def test_a_body_is_alone_where_it_is_in_the_whole(scene, random) -> None:
    pose = shaken(scene, random)
    whole = scene.place(pose).transforms
    for one in scene.free_bodies:
        alone = one.body.place(one.alone(pose)).transforms
        np.testing.assert_allclose(alone, whole[one.segments], atol=1e-12)
        np.testing.assert_allclose(
            one.body.markers.place(alone), scene.markers.place(whole)[one.markers], atol=1e-12
        )


def test_a_body_is_placed_and_the_others_stay(scene, random) -> None:
    pose, other = shaken(scene, random), shaken(scene, random)
    before, there = scene.place(pose).transforms, scene.place(other).transforms
    for one in scene.free_bodies:
        after = scene.place(one.placed(one.alone(other), pose)).transforms
        others = np.setdiff1d(np.arange(len(before)), one.segments)
        np.testing.assert_allclose(after[one.segments], there[one.segments], atol=1e-12)
        np.testing.assert_allclose(after[others], before[others], atol=1e-12)


def test_the_nearest_body_is_as_near_as_the_whole(scene, random) -> None:
    pose, points = shaken(scene, random), random.normal(size=(200, 3))
    gaps = gaps_to_each(scene, pose, points)
    np.testing.assert_allclose(gaps.min(axis=0), surface_gaps(scene, pose, points), atol=1e-6)


def test_one_body_has_none_beside_it() -> None:
    assert Template.parse("hand", place="test", field="template").body(0.19).free_bodies == ()


def test_a_ball_is_not_as_flat_as_a_wall(tmp_path, random) -> None:
    """Half of its surface is within a quarter of its radius along the line of sight."""
    (tmp_path / "ball.yaml").write_text(
        "title: A ball\nsize: {name: diameter, value: 0.1, range: [0.1, 0.1]}\n"
        "segments: {ball: {joint: {type: free}, "
        "capsules: [{start: [0, 0, 0], end: [0, 0, 0], radius: 0.05}]}}"
    )
    path = str(tmp_path / "ball.yaml")
    body = Template.parse(path, place="test", field="template").body(0.1)
    points = random.normal(size=(2000, 3))
    points *= 0.05 / np.linalg.norm(points, axis=1, keepdims=True)
    ball = points[points[:, 2] < -0.015]
    wall = np.column_stack([0.05 * random.uniform(-1, 1, (500, 2)), -0.05 * np.ones(500)])
    assert BodyFit.of(body, body.skeleton.rest(), ball).relief > 0.4
    assert BodyFit.of(body, body.skeleton.rest(), wall).relief < 0.1


def test_no_bone_is_drawn_between_bodies(scene) -> None:
    count = len(scene.skeleton.names)
    segments = np.concatenate([np.arange(count), scene.markers.segments])
    drawn = segments[bones_of(scene)]
    for one in scene.free_bodies:
        inside = np.isin(drawn, one.segments)
        assert (inside[:, 0] == inside[:, 1]).all()
        own = len(one.body.skeleton.names) - 1 + len(one.body.markers.segments)
        assert inside.all(axis=1).sum() == own
