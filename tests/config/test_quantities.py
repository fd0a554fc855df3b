"""Numbers that can only be mistakes are refused with their field."""

from __future__ import annotations

import re
from pathlib import Path

import pytest
from pydantic import TypeAdapter, ValidationError

from regkit.body import BodyDescription
from regkit.config.document import Document
from regkit.config.installed import OWN, only_from
from regkit.config.model import Model
from regkit.interfaces import SLOTS
from regkit.system.errors import ConfigError

TEMPLATE = """\
title: thing
size: {name: length, value: 1.0, range: [0.5, 2.0]}
stances:
  bent: {joints: {arm: 45, wrist: [10, 0, 0]}}
segments:
  root: {joint: {type: free}, capsules: [{start: [0, 0, 0], end: [0, 0.5, 0], radius: 0.1}]}
  arm:
    parent: root
    offset: [0, 0.5, 0]
    joint: {type: hinge, axis: x, limits_deg: [0, 90]}
    markers: {tip: [0, 1, 0]}
  wrist:
    parent: arm
    joint: {type: ball, swing_deg: [30, 30], twist_deg: [-20, 20]}
  finger:
    parent: wrist
    joint: {type: hinge, axis: x, coupled: {to: arm, ratio: 0.5}}
"""


def complaint(path: Path, text: str) -> str:
    path.write_text(text)
    with pytest.raises(ConfigError) as caught:
        Document.read(path).validated(BodyDescription)
    return str(caught.value).replace(str(path), "FILE")


def test_template_is_valid(tmp_path):
    (tmp_path / "a.yaml").write_text(TEMPLATE)
    Document.read(tmp_path / "a.yaml").validated(BodyDescription)


@pytest.mark.parametrize(
    ("old", "new", "place"),
    [
        ("offset: [0, 0.5, 0]", "offset: [0, 1e300, 0]", "FILE:9: segments.arm.offset[1]"),
        ("offset: [0, 0.5, 0]", "offset: [0, .nan, 0]", "FILE:9: segments.arm.offset[1]"),
        ("offset: [0, 0.5, 0]", "offset: [0, 500, 0]", "FILE:9: segments.arm.offset"),
        ("tip: [0, 1, 0]", "tip: [0, -1e9, 0]", "FILE:11: segments.arm.markers.tip[1]"),
        ("tip: [0, 1, 0]", "tip: [0, 1000, 0]", "FILE:11: segments.arm.markers.tip"),
        ("end: [0, 0.5, 0]", "end: [0, 500, 0]", "FILE:6: segments.root.capsules[0].end"),
        ("radius: 0.1", "radius: 0", "FILE:6: segments.root.capsules[0].radius"),
        ("radius: 0.1", "radius: -1", "FILE:6: segments.root.capsules[0].radius"),
        ("radius: 0.1", "radius: 1e9", "FILE:6: segments.root.capsules[0].radius"),
        ("radius: 0.1", "radius: 1e-300", "FILE:6: segments.root.capsules[0].radius"),
        ("radius: 0.1", "radius: [0.1, 900]", "FILE:6: segments.root.capsules[0].radius"),
        ("value: 1.0", "value: 3.0", "FILE:2: size.range"),
        ("value: 1.0", "value: 1e200", "FILE:2: size.value"),
        ("range: [0.5, 2.0]", "range: [2.0, 0.5]", "FILE:2: size.range"),
        ("range: [0.5, 2.0]", "range: [0, 2.0]", "FILE:2: size.range[0]"),
        ("range: [0.5, 2.0]", "range: [0.5, .inf]", "FILE:2: size.range[1]"),
        ("arm: 45", "arm: 95", "FILE:4: stances.bent.joints.arm"),
        ("arm: 45", "arm: 1e6", "FILE:4: stances.bent.joints.arm"),
        ("arm: 45", "amr: 45", "FILE:4: stances.bent.joints.amr"),
        ("arm: 45", "finger: 10", "FILE:4: stances.bent.joints.finger"),
        ("arm: 45", "arm: [1, 2, 3]", "FILE:4: stances.bent.joints.arm"),
        ("wrist: [10, 0, 0]", "wrist: [50, 0, 0]", "FILE:4: stances.bent.joints.wrist"),
        ("wrist: [10, 0, 0]", "wrist: [0, 40, 0]", "FILE:4: stances.bent.joints.wrist"),
        ("limits_deg: [0, 90]", "limits_deg: [90, 0]", "FILE:10: segments.arm.joint.limits_deg"),
        ("limits_deg: [0, 90]", "limits_deg: [0, 1e15]",
         "FILE:10: segments.arm.joint.limits_deg[1]"),
        ("axis: x, l", "axis: [1e300, 0, 0], l", "FILE:10: segments.arm.joint.axis[0]"),
        ("swing_deg: [30, 30]", "swing_deg: [30, 1e-300]",
         "FILE:14: segments.wrist.joint.swing_deg[1]"),
        ("ratio: 0.5", "ratio: 1e300", "FILE:17: segments.finger.joint.coupled.ratio"),
        ("ratio: 0.5", "ratio: 0.5, offset_deg: -1e9",
         "FILE:17: segments.finger.joint.coupled.offset_deg"),
    ],
)  # fmt: skip
def test_absurd_template_is_refused_with_its_field(tmp_path, old, new, place):
    assert old in TEMPLATE
    message = complaint(tmp_path / "a.yaml", TEMPLATE.replace(old, new))
    assert message.splitlines()[0].startswith(f"{place}: "), message


def numbers() -> list[object]:
    """Returns the fields of the built-in plug-ins whose type has a number."""
    with only_from(OWN):
        return [
            pytest.param(slot, kind, field, id=f"{slot.group}-{kind}-{field}")
            for slot in SLOTS
            for kind in slot.available()
            for field, info in slot.load(kind).model_fields.items()
            if {"int", "float"} & set(re.findall(r"\w+", str(info.annotation)))
        ]


@pytest.mark.parametrize(("slot", "kind", "field"), numbers())
def test_every_number_of_a_built_in_plug_in_has_bounds(slot, kind, field):
    info = slot.load(kind).model_fields[field]
    number = TypeAdapter(info.rebuild_annotation(), config={"arbitrary_types_allowed": True})
    for absurd in (1e300, -1e300, 10**30, -(10**30)):
        with pytest.raises(ValidationError):
            number.validate_python(absurd)


class Anything(Model):
    number: float = 0.0
    count: int = 0


@pytest.mark.parametrize("values", [{"number": 1e300}, {"count": 10**30}, {"number": -(10**400)}])
def test_numbers_beyond_all_use_are_refused_without_bounds_of_their_own(values):
    with pytest.raises(ValueError, match="Input should be"):
        Anything.model_validate(values)
