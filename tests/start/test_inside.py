"""The start of a composed body: its base first, then the parts inside."""

from pathlib import Path

import numpy as np
import pytest

from regkit.interfaces import StartSearch, Template
from regkit.observation import Observation
from tests.support.scarecrow import GRIPPER, POLE, measured, standing


@pytest.fixture
def template(tmp_path: Path) -> Template:
    """The scarecrow of known height."""
    for name, text in (("pole", POLE), ("gripper", GRIPPER)):
        (tmp_path / f"{name}.yaml").write_text(text)
    base = {"kind": "file", "path": str(tmp_path / "pole.yaml"), "size": 1.0}
    hand = {"kind": "file", "path": str(tmp_path / "gripper.yaml")}
    composed = {"kind": "composed", "base": base, "at": {"hand": hand}}
    return Template.parse(composed, place="test", field="template")


@pytest.fixture
def seen(template: Template) -> Observation:
    body = template.body(1.0)
    return measured(body, standing(body, arm=30, hand=-35, hand_thumb=-35, hand_finger=30))


@pytest.mark.parametrize(
    "search", [{"kind": "stances"}, {"kind": "exemplars", "exemplars": 500, "looked_up": 100}]
)
def test_the_parts_are_found_inside_the_base(template, seen, search) -> None:
    start = StartSearch.parse(search, place="test", field="start").find(template, [seen])
    assert start.body.name == "composed"
    body = start.body
    truth = standing(body, arm=30, hand=-35, hand_thumb=-35, hand_finger=30)
    places = [body.markers.place(body.place(pose).transforms) for pose in (start.pose, truth)]
    errors = dict(
        zip(body.markers.names, np.linalg.norm(places[0] - places[1], axis=1), strict=True)
    )
    for marker in ("elbow", "hand_palm", "hand_thumb_tip", "hand_finger_tip"):
        assert errors[marker] < 0.03, errors


def test_a_template_without_parts_has_no_base_to_begin_with() -> None:
    assert Template.parse("human", place="test", field="template").coarse() is None
    hands = {"left": {"kind": "hand", "side": "left"}, "right": "hand"}
    free = Template.parse({"kind": "composed", "free": hands}, place="test", field="template")
    assert free.coarse() is None
    assert free.body(0.19).base is None
