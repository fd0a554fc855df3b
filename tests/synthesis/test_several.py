"""Several bodies in one take: the whole is its parts, each along its course."""

from __future__ import annotations

from itertools import pairwise
from typing import Any

import numpy as np
import pytest

from regkit.config.document import Document
from regkit.sensors import CAMERAS, Sensor
from regkit.system.errors import ConfigError
from regkit_plugins.datasets.synthetic import Synthetic
from regkit_plugins.presets import TWO_HANDS
from regkit_synthesis.bodies.hand import ShippedHand
from regkit_synthesis.recordings.scene import Scene
from regkit_synthesis.recordings.take import Take

SENSOR = Sensor(CAMERAS["sr305"].camera(), 0.0, CAMERAS["sr305"].depth_scale)
PRESET = Document.read(TWO_HANDS).validated(Synthetic)
FISTS = {"kind": "gestures", "name": "fists"}
RIGHT = {"body": {"kind": "hand"}, "motion": FISTS, "course": [{"place": [0.1, 0.0, 0.0]}]}
LEFT = {
    "body": {"kind": "hand", "side": "left"},
    "motion": FISTS,
    "course": [{"place": [-0.1, 0.0, 0.0]}],
}
CAN = {"body": {"kind": "cylinder", "radius": 0.02, "height": 0.1}}


def scene(**fields: Any) -> Scene:
    """Returns the scene of a take of 20 frames, 50 cm before the camera."""
    take = Take.model_validate({"view": {"place": [0.0, 0.0, 0.5]}, "frames": 20, **fields})
    return take.scene("take", SENSOR, 10.0, take.frames)


def test_a_whole_has_the_truth_of_its_parts_under_their_names() -> None:
    """Joints of each part are those of the part alone."""
    whole = scene(bodies={"right": RIGHT, "left": LEFT})
    parts = {"right": scene(**RIGHT), "left": scene(**LEFT)}
    names = [f"{part}_{joint}" for part, alone in parts.items() for joint in alone.joints]
    assert list(whole.joints) == names
    expected = np.concatenate([alone.truth() for alone in parts.values()], axis=1)
    np.testing.assert_allclose(whole.truth(), expected, atol=1e-12)


def test_a_whole_looks_like_the_nearest_of_its_parts() -> None:
    """The picture of two hands is the nearer of both pictures."""
    near = {**LEFT, "course": [{"place": [0.05, -0.1, 0.0]}]}
    whole, *alone = (
        next(iter(scene(**fields).views())).depth
        for fields in ({"bodies": {"right": RIGHT, "left": near}}, RIGHT, near)
    )
    stacked = np.array([np.where(depth > 0.0, depth, np.inf) for depth in alone]).min(axis=0)
    assert np.isfinite(alone[0] * alone[1]).all()
    assert ((alone[0] > 0.0) & (alone[1] > 0.0)).any()
    np.testing.assert_allclose(np.where(whole > 0.0, whole, np.inf), stacked, atol=1e-6)


def test_a_left_hand_is_the_mirror_image_of_a_right_one() -> None:
    """Left and right exchanged, joints and picture are the same; triangles face outwards."""
    right, left = (
        scene(body={"kind": "hand", "side": side}, motion=FISTS) for side in ("right", "left")
    )
    assert right.joints == left.joints
    np.testing.assert_allclose(left.truth() * [-1.0, 1.0, 1.0], right.truth(), atol=1e-12)
    assert not any(label.endswith(".R") for label in left.mesh.labels)
    volumes = [
        np.linalg.det(body.mesh.vertices[body.mesh.faces]).sum()
        for body in (ShippedHand().body(), ShippedHand(side="left").body())
    ]
    assert volumes[0] > 0.0
    assert volumes[1] == pytest.approx(volumes[0])


def test_a_course_passes_its_places_and_rests_outside() -> None:
    """The centre of an object is at each place, turned, in time."""
    course = [
        {"time": 0.5, "place": [0.1, 0.0, 0.0]},
        {"time": 1.0, "place": [-0.1, 0.05, 0.1], "rotation_deg": [0.0, 90.0, 0.0]},
    ]
    truth = scene(**CAN, course=course).truth()
    np.testing.assert_allclose(truth[:6, 0], np.tile([0.1, 0.0, 0.5], (6, 1)), atol=1e-12)
    np.testing.assert_allclose(truth[10:, 0], np.tile([-0.1, -0.1, 0.55], (10, 1)), atol=1e-12)
    axis = truth[:, 2] - truth[:, 1]
    np.testing.assert_allclose(axis[0], [0.0, -0.1, 0.0], atol=1e-12)
    np.testing.assert_allclose(axis[-1], [0.1, 0.0, 0.0], atol=1e-12)


def test_what_is_carried_keeps_its_place_in_the_hand() -> None:
    """The distances of an object's points to the palm never change."""
    moving = {**RIGHT, "course": [{"place": [0.1, 0, 0]}, {"time": 1, "place": [-0.1, 0, 0]}]}
    held = {**CAN, "course": [{"place": [0.1, -0.05, 0.0]}], "carrier": "hand"}
    whole = scene(bodies={"can": held, "hand": moving})
    order = {joint: index for index, joint in enumerate(whole.joints)}
    palm = [order[f"hand_{joint}"] for joint in ("wrist", "index_mcp", "little_mcp")]
    can = [order[f"can_{mark}"] for mark in ("centre", "top", "bottom")]
    truth = whole.truth()
    apart = np.linalg.norm(truth[:, palm, None] - truth[:, None, can], axis=3)
    assert np.ptp(truth[:, can[0], 0]) > 0.1
    np.testing.assert_allclose(apart, np.broadcast_to(apart[:1], apart.shape), atol=1e-9)


@pytest.mark.parametrize(
    ("bodies", "told"),
    [
        ({"can": {**CAN, "carrier": "hand"}}, "hand"),
        ({"a": {**CAN, "carrier": "b"}, "b": {**CAN, "carrier": "a"}}, "carrie"),
        ({"can": {**CAN, "motion": FISTS}}, "course"),
        ({"hand": {"body": {"kind": "hand"}}}, "motion"),
    ],
)
def test_what_cannot_move_is_refused_with_its_name(bodies: dict[str, Any], told: str) -> None:
    """A wrong carrier or motion names the body."""
    with pytest.raises(ConfigError, match=told) as refused:
        scene(bodies=bodies)
    assert any(name in str(refused.value) for name in bodies)


def test_one_body_and_several_exclude_each_other() -> None:
    """A take has one body, or several."""
    with pytest.raises(ValueError, match="bodies or motion"):
        Take.model_validate({"motion": "walk", "bodies": {"can": CAN}})


def test_defaults_of_one_body_give_way_to_several() -> None:
    """A take with several bodies takes nothing of a default body, and the other way round."""
    dataset = Synthetic.model_validate(
        {
            "defaults": {"motion": "walk", "frames": 3},
            "takes": {"a": {}, "b": {"bodies": {"c": CAN}}},
        }
    )
    assert dataset.takes["b"].motion is None
    assert dataset.takes["b"].frames == 3


@pytest.mark.parametrize("name", PRESET.takes)
def test_the_hands_of_the_preset_cross_within_the_picture(name: str) -> None:
    """Both hands move smoothly in the picture and come within a hand's breadth or cross."""
    (recording,) = Synthetic.model_validate(
        {**PRESET.model_dump(exclude_unset=True), "recordings": [name]}
    ).chosen()
    truth = recording.truth()
    assert truth is not None
    camera = CAMERAS["sr305"].camera()
    x = camera.fx * truth.positions[..., 0] / truth.positions[..., 2] + camera.cx
    assert ((x > 0.0) & (x < camera.width)).all()
    steps = [np.linalg.norm(b - a, axis=1).max() for a, b in pairwise(truth.positions)]
    assert max(steps) < 0.05
    gaps = np.linalg.norm(truth.positions[:, :21, None] - truth.positions[:, None, 21:], axis=3)
    assert gaps.min(axis=(1, 2))[0] > 0.05
    assert gaps.min() < 0.09
