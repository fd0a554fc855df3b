"""The limbs of a body with parts: those of its base end with a part, which has its own."""

import numpy as np

from regkit.interfaces.template import Template
from regkit.search.limb_search import LimbSearch
from regkit.search.limbs import limbs_of
from tests.support.scarecrow import measured, scarecrow, standing
from tests.support.two_lamps import described


def test_an_arm_ends_with_its_hand_and_the_fingers_are_limbs() -> None:
    body = scarecrow()
    names = body.skeleton.names
    limbs = {limb.name: {names[one] for one in limb.segments} for limb in limbs_of(body)}
    assert limbs["hand_thumb"] == {"hand_thumb"}
    assert limbs["hand_finger"] == {"hand_finger"}
    assert set(limbs) == {"hand_thumb", "hand_finger"}


def test_bodies_that_are_free_in_a_scene_are_no_limbs() -> None:
    body = described().body("lamps", 1.0)
    assert limbs_of(body) == []


def test_a_persons_arms_reach_to_the_fingertips() -> None:

    person = Template.parse(
        {
            "kind": "composed",
            "base": "human",
            "at": {"left_hand": {"kind": "hand", "side": "left"}},
        },
        place="test",
        field="template",
    ).body(1.7)
    names = person.skeleton.names
    limbs = {limb.name: limb for limb in limbs_of(person)}
    arm = limbs["left_upper_arm"]
    assert {names[one] for one in arm.segments} >= {"left_forearm", "left_hand_index_3"}
    wrist = person.skeleton.joint_dofs["left_hand"][0] - person.skeleton.ball_dofs.start
    assert wrist // 3 in arm.balls
    assert not len(np.intersect1d(arm.hinges, limbs["left_hand_index_1"].hinges))
    assert len([name for name in limbs if name.startswith("left_hand_")]) == 5


def test_what_a_finger_gains_counts_beside_its_hand_alone() -> None:
    body = scarecrow()
    pose = standing(body, arm=25)
    seen = measured(body, pose)
    search = next(iter(LimbSearch.of_all(body, np.random.default_rng(0), 10)))
    beside = search.beside(seen.points, pose)
    assert isinstance(beside, np.ndarray)
    assert 20 < beside.sum() < 0.6 * len(seen.points)
