"""Composed templates: several bodies in one, with their own names, sizes and parts."""

import numpy as np
import pytest

from regkit.interfaces.template import Template
from regkit.system.errors import ConfigError


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


def test_a_composition_of_nothing_is_refused() -> None:
    with pytest.raises(ConfigError, match="free"):
        composed(free={})
