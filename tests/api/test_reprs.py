"""What a notebook shows of an object is a few lines, whatever the object holds."""

import pytest
from places import DATA

import regkit
from regkit.interfaces import Method, ShapeModel


@pytest.fixture(scope="module")
def objects() -> dict[str, object]:
    recording = regkit.load_recording(DATA / "human_walk")
    template = regkit.load_template("human", height=1.63)
    body = template.body(1.63)
    method = Method.parse("best", place="test", field="method")
    primitives = ShapeModel.load("gsog")().bind(body)
    pose = body.skeleton.rest()
    return {
        "recording": recording,
        "truth": recording.truth(),
        "frame": regkit.load_frame(DATA / "human_walk"),
        "template": template,
        "description": template.description(),
        "body": body,
        "skeleton": body.skeleton,
        "limits": body.skeleton.limits,
        "markers": body.markers,
        "capsules": body.capsules,
        "surface": body.surface,
        "placement": body.place(pose),
        "pose": pose,
        "method": method,
        "registrar": method.bind(body),
        "primitives": primitives,
        "placed": primitives.place(body.place(pose).transforms),
    }


def test_repr_is_a_few_lines(objects):
    for name, one in objects.items():
        for text in (repr(one), str(one)):
            assert 20 < len(text) < 900, (name, text)
            assert type(one).__name__ in text


def test_repr_of_a_body_says_what_it_consists_of(objects):
    text = repr(objects["body"])
    for part in ("human", "1.63 m", "segments", "hinges", "markers"):
        assert part in text


def test_repr_of_a_small_model_is_complete():
    assert repr(regkit.load_template("human", height=1.63)).endswith("height=1.63)")
