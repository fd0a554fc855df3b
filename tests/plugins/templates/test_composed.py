"""Composed templates: several bodies in one, with their own names, sizes and parts."""

import numpy as np
import pytest

from regkit.body import Body
from regkit.body.writing import template_text
from regkit.interfaces.template import Template
from regkit.system.errors import ConfigError
from regkit_plugins.templates.file import FileTemplate


def composed(**fields: object) -> Template:
    return Template.parse({"kind": "composed", **fields}, place="test", field="template")


def two_hands(**right: object) -> Template:
    hands = {
        "left": {"kind": "hand", "side": "left"},
        "right": {"kind": "hand", "side": "right", **right},
    }
    return composed(free=hands)


def test_free_bodies_have_names_of_their_own() -> None:
    body = two_hands().body(0.19)
    assert {"left_palm", "right_palm", "world"} <= set(body.skeleton.names)
    assert {"left_thumb_tip", "right_thumb_tip"} <= set(body.markers.names)


def test_each_body_is_a_part() -> None:
    body = two_hands().body(0.19)
    alone = Template.parse({"kind": "hand"}, place="test", field="template").body(0.19)
    assert [(part.name, part.free, part.size) for part in body.parts] == [
        ("left", True, pytest.approx(0.19)),
        ("right", True, pytest.approx(0.19)),
    ]
    left, right = body.parts
    assert len(left.segments) == len(right.segments) == len(alone.skeleton.names)
    assert len(left.dofs) == len(right.dofs) == alone.skeleton.dofs
    assert not np.intersect1d(left.dofs, right.dofs).size
    moved = body.skeleton.dof_mask[left.dofs].any(axis=0)
    assert set(np.flatnonzero(moved)) == set(left.segments)


def test_a_given_size_stays_and_the_others_follow() -> None:
    template = two_hands(length=0.17)
    assert template.given_size() is None
    left, right = template.body(0.2).parts
    assert left.size == pytest.approx(0.2)
    assert right.size == pytest.approx(0.17)
    assert two_hands(length=0.17).candidate_sizes() == two_hands().candidate_sizes()


def test_a_body_is_the_same_beside_others_as_alone() -> None:
    """Its surface, markers and primitives in their segments' frames."""
    whole = two_hands().body(0.2)
    alone = Template.parse({"kind": "hand"}, place="test", field="template").body(0.2)
    right = [whole.skeleton.names.index(f"right_{name}") for name in alone.skeleton.names]
    own = np.isin(whole.capsules.segments, right)
    np.testing.assert_allclose(whole.capsules.ends[own], alone.capsules.ends, atol=1e-12)
    np.testing.assert_allclose(whole.capsules.radii[own], alone.capsules.radii, atol=1e-12)
    own = np.isin(whole.markers.segments, right)
    np.testing.assert_allclose(whole.markers.points[own], alone.markers.points, atol=1e-12)
    assert set(whole.shapes) == set(alone.shapes)
    for kind, listed in alone.shapes.items():
        both = whole.shapes[kind]
        mine = [
            one for one, at in zip(both.parameters, both.segments, strict=True) if at in set(right)
        ]
        for one, other in zip(mine, listed.parameters, strict=True):
            np.testing.assert_allclose(one.moments()[0], other.moments()[0], atol=1e-12)
            np.testing.assert_allclose(one.moments()[1], other.moments()[1], atol=1e-12)


def test_stances_of_one_name_are_one() -> None:
    body = two_hands().body(0.2)
    names = [stance.name for stance in body.stances]
    assert names == ["rest", "relaxed", "fist", "pointing"]


def test_a_person_may_be_beside_an_object_without_the_lists_of_the_other() -> None:
    body = composed(free={"person": "human", "hand": "hand"}).body(1.7)
    assert [part.name for part in body.parts] == ["person", "hand"]
    assert len(body.shapes["gsog/best"]) == 13 + 18


def person_with_hands(**hands: object) -> Template:
    sides = {f"{side}_hand": {"kind": "hand", "side": side, **hands} for side in ("left", "right")}
    return composed(base={"kind": "human"}, at=sides)


@pytest.fixture(scope="module")
def person() -> Body:
    return person_with_hands().body(1.7)


def test_hands_replace_those_of_a_person(person) -> None:
    names = person.skeleton.names
    assert [part.name for part in person.parts] == ["body", "left_hand", "right_hand"]
    assert [part.free for part in person.parts] == [True, False, False]
    assert len(names) == 15 - 2 + 2 * 16
    hand = person.parts[1]
    assert {names[segment] for segment in hand.segments} >= {"left_hand", "left_hand_thumb_1"}
    wrist = person.skeleton.joint_dofs["left_hand"]
    assert set(wrist) <= set(hand.dofs)


def test_what_is_measured_of_a_person_stays_where_it_is(person) -> None:
    """The 20 markers of a person lie where they lie without the parts, and a hand has 21 more."""
    alone = Template.parse("human", place="test", field="template").body(1.7)
    placed = {
        name: at
        for body in (person, alone)
        for name, at in zip(
            [f"{'parts ' if body is person else ''}{one}" for one in body.markers.names],
            body.markers.place(body.place(body.skeleton.rest()).transforms),
            strict=True,
        )
    }
    assert len(person.markers.names) == len(alone.markers.names) + 2 * 21
    for name in alone.markers.names:
        np.testing.assert_allclose(placed[f"parts {name}"], placed[name], atol=3e-4)
    np.testing.assert_allclose(placed["parts left_hand_wrist"], placed["left_wrist"], atol=3e-4)


def test_a_hand_points_where_that_of_the_person_does(person) -> None:
    """The fingers hang down, the palms face the thighs, and the thumbs are in front."""
    rest = person.skeleton.rest()
    markers = person.markers.place(person.place(rest).transforms)
    at = dict(zip(person.markers.names, markers, strict=True))
    for side, outward in (("left", 1.0), ("right", -1.0)):
        hand = f"{side}_hand_"
        along = at[hand + "middle_tip"] - at[hand + "wrist"]
        assert along[1] < -0.9 * np.linalg.norm(along)
        assert at[hand + "thumb_tip"][2] > at[hand + "middle_mcp"][2]
        palm = person.place(rest).transforms[person.skeleton.names.index(f"{side}_hand"), :3, 2]
        assert outward * palm[0] < -0.9


@pytest.mark.parametrize("build", ["average", "small", "tall"])
def test_hands_have_the_size_of_the_person_unless_it_is_given(build: str) -> None:
    base = {"kind": "human", "build": build}
    hand = {"kind": "hand", "side": "left"}
    own = composed(base=base, at={"left_hand": hand}).body(1.6)
    larger = composed(base=base, at={"left_hand": hand}).body(1.8)
    given = composed(base=base, at={"left_hand": {**hand, "length": 0.2}}).body(1.6)
    assert 0.105 * 1.6 < own.parts[1].size < 0.12 * 1.6
    assert larger.parts[1].size / own.parts[1].size == pytest.approx(1.8 / 1.6)
    assert given.parts[1].size == pytest.approx(0.2)
    assert composed(base=base, at={"left_hand": hand}).given_size() is None


def test_every_list_of_a_person_has_its_hands_once(person) -> None:
    """No primitive of the forearm stands for the hand too, which has some of its own."""
    for key, listed in person.shapes.items():
        names = [person.skeleton.names[segment] for segment in listed.segments]
        assert {"left_hand", "left_hand_index_3", "left_forearm"} <= set(names), key
        wrist = person.skeleton.link_offsets[
            person.skeleton.segment_links[person.skeleton.names.index("left_hand")]
        ]
        for name, one in zip(names, listed.parameters, strict=True):
            mean, covariance = one.moments()
            if name == "left_forearm":
                assert mean[1] - np.sqrt(covariance[1, 1]) > wrist[1, 3], key


def test_the_skin_of_the_whole_is_that_of_its_parts(person) -> None:
    surface = person.surface
    assert surface is not None
    assert surface.rest is not None
    carried = surface.rest[surface.segments]
    places = np.einsum("vaij,vaj->vai", carried[..., :3, :3], surface.points) + carried[..., :3, 3]
    first = places[:, :1] + np.zeros_like(places)
    weighty = surface.blend > 1e-6
    np.testing.assert_allclose(places[weighty], first[weighty], atol=1e-6)
    vertices = surface.place(person.place(person.skeleton.rest()).transforms)
    distances = person.capsules.place(
        person.place(person.skeleton.rest()).transforms
    ).surface_distance(vertices)
    assert np.quantile(np.abs(distances), 0.9) < 0.03


@pytest.mark.parametrize(
    ("fields", "message"),
    [
        ({}, "base"),
        ({"at": {"left_hand": "hand"}}, "base"),
        ({"base": "human", "at": {"left_hands": "hand"}}, "did you mean 'left_hand'"),
        ({"base": "hand", "at": {"palm": "hand"}}, "no socket"),
        ({"base": "human", "free": {"body": "hand"}}, "'body' already"),
        ({"base": "human", "free": {"left": {"kind": "hand", "side": "left"}}}, "left_wrist"),
    ],
)
def test_what_does_not_fit_together_is_refused(fields: dict[str, object], message: str) -> None:
    with pytest.raises(ConfigError, match=message):
        composed(**fields)


@pytest.mark.parametrize(
    "fields",
    [
        {"base": "human", "at": {"left_hand": {"kind": "hand", "side": "left"}}},
        {"free": {"left": {"kind": "hand", "side": "left"}, "right": "hand"}},
    ],
    ids=["attached", "free"],
)
def test_a_composition_is_a_template_that_can_be_written(
    fields: dict[str, object], tmp_path
) -> None:
    """The file gives the same joints and parts; lengths are rounded."""
    description = composed(**fields).description()
    path = tmp_path / "whole.yaml"
    path.write_text(template_text(description, "A composed template.", {}))
    size = description.size.value
    written = FileTemplate(path=path).body(size)
    body = description.body("whole", size)
    assert [part.name for part in written.parts] == [part.name for part in body.parts]
    for one, other in zip(written.parts, body.parts, strict=True):
        np.testing.assert_array_equal(one.dofs, other.dofs)
        assert one.free == other.free
    places = [
        one.markers.place(one.place(one.skeleton.rest()).transforms) for one in (written, body)
    ]
    np.testing.assert_allclose(places[0], places[1], atol=2e-3)


def test_a_person_with_a_hand_beside_another_hand() -> None:
    """Parts and free bodies in one: the person is then free in the scene too."""
    hand = {"kind": "hand", "side": "left"}
    body = composed(base="human", at={"left_hand": hand}, free={"other": "hand"}).body(1.7)
    assert [(part.name, part.free) for part in body.parts] == [
        ("body", True),
        ("left_hand", False),
        ("other", True),
    ]
    assert sorted(np.concatenate([part.dofs for part in body.parts])) == [
        *range(body.skeleton.dofs)
    ]
    assert body.base is None
    assert body.surface is not None
    placed = body.surface.place(body.place(body.skeleton.rest()).transforms)
    assert np.isfinite(placed).all()
