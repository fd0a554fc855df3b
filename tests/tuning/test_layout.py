"""Any number of primitives fill a body: as many as asked for, inside it, on both sides alike."""

from collections import Counter
from dataclasses import replace
from functools import partial

import numpy as np
import pytest
from numpy.testing import assert_allclose

from regkit.body import (
    BallParameters,
    BodyDescription,
    CapsuleParameters,
    GaussianParameters,
    Mirror,
    ParametricShape,
)
from regkit.body.reading import description_in
from regkit.body.writing import template_text
from regkit.primitives import Gaussians
from regkit.system.errors import ConfigError
from regkit.testing.samples import linkage
from regkit.tuning.layout import divided, one_per_capsule, segment_clusters
from regkit_plugins.templates.human import Human


def count(listed):
    return sum(map(len, listed.values()))


def other_side(name):
    sides = {"left": "right", "right": "left"}
    return "_".join(sides.get(part, part) for part in name.split("_"))


def difference(one, other):
    moments = zip(one.moments(), other.moments(), strict=True)
    return max(float(np.abs(own - its).max()) for own, its in moments)


def segments(body):
    return {body.skeleton.names[index] for index in body.capsules.segments}


@pytest.mark.parametrize("alike", [False, True])
@pytest.mark.parametrize("number", [13, 14, 15, 16, 26, 41, 60])
def test_a_person_has_as_many_primitives_as_asked_for_and_is_its_own_mirror_image(
    human, number, alike
):
    listed = divided(human, GaussianParameters, number, alike=alike)
    assert count(listed) == number
    assert ("left_hand" in listed) == (number >= 15)
    for name, own in listed.items():
        twin = other_side(name)
        images = [one.deformed(Mirror()) for one in own]
        if twin != name:
            assert images == list(listed[twin])
            continue
        for image in images:
            assert min(difference(image, one) for one in own) < 3e-4


@pytest.mark.parametrize("number", [16, 18, 26, 48])
def test_a_hand_has_as_many_primitives_as_asked_for_on_all_segments(hand, number):
    listed = divided(hand, GaussianParameters, number)
    assert count(listed) == number
    assert set(listed) == segments(hand)


@pytest.mark.parametrize("made", [GaussianParameters, BallParameters, CapsuleParameters])
def test_primitives_lie_within_the_body(body, made):
    number = len(segments(body)) + 8
    listed = divided(body, made, number)
    transforms = body.place(body.skeleton.rest()).transforms
    for name, own in listed.items():
        index = body.skeleton.names.index(name)
        capsules = body.capsules.place(transforms)
        means = np.array([one.moments()[0] for one in own])
        placed = means @ transforms[index, :3, :3].T + transforms[index, :3, 3]
        assert (capsules.surface_distance(placed) < 0.0).all()


def test_more_primitives_are_nearer_to_the_points_of_the_body(body):
    least = len(segments(body))
    spreads = []
    for number in (least, least + 6, least + 20):
        listed = divided(body, BallParameters, number)
        spreads.append(max(one.sigma for own in listed.values() for one in own))
    assert spreads[0] > spreads[1] > spreads[2]


def test_thin_segments_have_more_where_all_count_alike(hand):
    by_volume, alike = (divided(hand, GaussianParameters, 40, alike=each) for each in (False, True))
    assert len(alike["palm"]) < len(by_volume["palm"])
    assert len(alike["middle_2"]) > len(by_volume["middle_2"])


def test_a_body_needs_a_primitive_for_each_segment_that_moves(human, hand):
    with pytest.raises(ConfigError, match=r"12 primitives.*at least 13"):
        divided(human, GaussianParameters, 12)
    with pytest.raises(ConfigError, match=r"15 primitives.*at least 16"):
        divided(hand, GaussianParameters, 15)


def test_a_body_cannot_be_divided_without_end(monkeypatch):
    monkeypatch.setattr(segment_clusters, "POINTS", 300)
    with pytest.raises(ConfigError, match="into at most"):
        divided(linkage(), BallParameters, 1000)


@pytest.mark.parametrize("make", [one_per_capsule, partial(divided, count=20)])
def test_a_body_without_capsules_cannot_be_filled(human, make):
    none = human.capsules.selected(human.capsules.segments < 0)
    with pytest.raises(ConfigError, match="no capsules"):
        make(replace(human, capsules=none), made=BallParameters)


def test_one_primitive_for_each_capsule_is_what_gsog_makes_without_a_list(body):
    listed = one_per_capsule(body, GaussianParameters)
    of_segments = Counter(body.skeleton.names[index] for index in body.capsules.segments)
    assert {name: len(own) for name, own in listed.items()} == of_segments
    made = ParametricShape.load("gsog")().bind(replace(body, shapes={}))
    assert isinstance(made, Gaussians)
    centres = np.array([one.centre for own in listed.values() for one in own])
    order = np.argsort(body.capsules.segments, kind="stable")
    assert_allclose(centres, made.centres[order])


def test_divided_body_is_a_list_of_a_template(tmp_path):
    description = Human().description()
    listed = divided(description.body("human", description.size.value), GaussianParameters, 26)
    shapes = dict(description.shapes) | {"gsog/26": listed}
    other = description.model_copy(update={"shapes": shapes, "mesh": None, "modes": None})
    written = tmp_path / "human.yaml"
    written.write_text(template_text(other, "A person.", {}))
    read = description_in(written).shapes["gsog/26"]
    assert list(read) == list(listed)
    for name, own in listed.items():
        for one, again in zip(own, read[name], strict=True):
            assert difference(one, again) < 1e-4


def test_sides_are_alike_in_any_plane_of_symmetry():
    arm = {"parent": "trunk", "joint": {"type": "ball"}}
    ends = {"start": (0.0, 0.0, 0.0), "end": (0.1, 0.2, 0.3), "radius": (0.05, 0.03)}
    reflection = np.diag([1.0, 1.0, -1.0])
    mirrored = {**ends, "end": tuple(reflection @ ends["end"])}
    body = BodyDescription.model_validate({
        "title": "Arms along z",
        "size": {"name": "span", "value": 1.0, "range": (0.5, 2.0)},
        "segments": {
            "trunk": {
                "joint": {"type": "free"},
                "capsules": [{"start": (0, 0, -0.1), "end": (0, 0.1, 0.1), "radius": 0.1},
                             {"start": (0, 0, 0.1), "end": (0, 0.1, -0.1), "radius": 0.1}],
            },
            "near": {**arm, "offset": (0.0, 0.1, 0.2), "capsules": [ends]},
            "far": {**arm, "offset": (0.0, 0.1, -0.2), "capsules": [mirrored]},
        },
    }).body("arms", 1.0)  # fmt: skip
    listed = divided(body, GaussianParameters, 9)
    assert count(listed) == 9
    pairs = [
        *zip(listed["near"], listed["far"], strict=True),
        *((one, min(listed["trunk"], key=lambda other, one=one: off(one, other, reflection)))
          for one in listed["trunk"]),
    ]  # fmt: skip
    assert all(off(one, other, reflection) < 3e-4 for one, other in pairs)


def off(one, other, reflection):
    (mean, spread), (its_mean, its_spread) = one.moments(), other.moments()
    return max(
        np.abs(reflection @ mean - its_mean).max(),
        np.abs(reflection @ spread @ reflection - its_spread).max(),
    )
