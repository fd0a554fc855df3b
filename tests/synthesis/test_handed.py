"""People with moving fingers: the hands of the same body, where its arms are."""

import numpy as np
import pytest

from regkit.system.errors import ConfigError
from regkit_synthesis.bodies.bodies import ShippedBody
from regkit_synthesis.bodies.handed import HandedBody
from regkit_synthesis.bodies.landmarks import placed
from regkit_synthesis.hands import GesturesConfig, HandsConfig
from regkit_synthesis.motion.config import KeyframesConfig

HANDS = HandsConfig(right=GesturesConfig(name="signs"), left=GesturesConfig(name="fists"))
FORWARD = KeyframesConfig(kind="keyframes", name="hands_forward", grounded=False)


@pytest.fixture(scope="module", params=["average", "small"])
def name(request) -> str:
    return request.param


@pytest.fixture(scope="module")
def person(name) -> HandedBody:
    body = ShippedBody(name=name, hands=HANDS).body()
    assert isinstance(body, HandedBody)
    return body


def test_a_person_with_fingers_has_the_same_skin_at_rest(person, name) -> None:
    plain = ShippedBody(name=name).body().mesh
    np.testing.assert_allclose(person.mesh.posed(person.mesh.rest), plain.vertices, atol=1e-5)
    np.testing.assert_allclose(person.mesh.weights.sum(axis=1), 1.0, atol=1e-5)


def test_the_body_moves_as_without_fingers(person, name) -> None:
    """Its joints, and the skin from the elbows inwards."""
    plain = ShippedBody(name=name).body()
    moved, unmoved = person.moved_by(FORWARD), plain.moved_by(FORWARD)
    for time in (0.0, 1.1, 2.3):
        own = placed(person.landmarks, person.mesh, moved(time))
        others = placed(plain.landmarks, plain.mesh, unmoved(time))
        names = list(person.landmarks)
        same = [names.index(joint) for joint in plain.landmarks]
        np.testing.assert_allclose(own[same], others, atol=1e-6)


def test_a_hand_has_21_joints_at_its_wrist(person) -> None:
    names, moved = list(person.landmarks), person.moved_by(FORWARD)
    assert len(names) == 20 + 2 * 21
    for time in (0.0, 0.9, 2.0):
        at = dict(zip(names, placed(person.landmarks, person.mesh, moved(time)), strict=True))
        for side in ("left", "right"):
            np.testing.assert_allclose(at[f"{side}_hand_wrist"], at[f"{side}_wrist"], atol=2e-3)
            length = np.linalg.norm(at[f"{side}_hand_middle_mcp"] - at[f"{side}_wrist"])
            assert 0.07 < length < 0.13


def test_the_left_hand_is_the_mirror_image_of_a_right_one() -> None:
    same = HandsConfig(right=GesturesConfig(name="signs"), left=GesturesConfig(name="signs"))
    person = ShippedBody(hands=same).body()
    still = KeyframesConfig(
        kind="keyframes", frames=[{"time": 0.0}, {"time": 9.0}], ahead=False, grounded=False
    )
    names, moved = list(person.landmarks), person.moved_by(still)
    for time in (0.5, 1.7):
        places = placed(person.landmarks, person.mesh, moved(time))
        at = dict(zip(names, places, strict=True))
        for joint in [one for one in names if one.startswith("left_hand_")]:
            other = at[joint.replace("left", "right")]
            np.testing.assert_allclose(at[joint] * [-1.0, 1.0, 1.0], other, atol=2e-3)


def test_a_fist_is_nearer_to_the_wrist_than_an_open_hand(person) -> None:
    names = list(person.landmarks)
    moved = person.moved_by(FORWARD)
    reach = []
    for time in np.linspace(0.0, 2.5, 12):
        at = dict(zip(names, placed(person.landmarks, person.mesh, moved(time)), strict=True))
        reach.append(np.linalg.norm(at["left_hand_middle_tip"] - at["left_hand_wrist"]))
    assert min(reach) < 0.75 * max(reach)


def test_gestures_alone_do_not_move_a_person(person) -> None:
    with pytest.raises(ConfigError, match="gestures"):
        person.moved_by(GesturesConfig(name="signs"))
