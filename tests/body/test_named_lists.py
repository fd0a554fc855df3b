"""Several lists of primitives for one shape model: each takes the list that it names."""

from pathlib import Path

import numpy as np
import pytest
from pydantic import ValidationError

from regkit.body import BodyDescription
from regkit.body.groups import Groups
from regkit.body.proportions import Proportions
from regkit.body.writing import template_text
from regkit.config.document import Document
from regkit.interfaces import ListedShapeModel, ShapeModel
from regkit.system.errors import ConfigError

LISTS = """\
shapes:
  sog: {base: [{centre: [0.1, 0, 0], sigma: 0.1}]}
  sog/paper: {base: [{centre: [0.2, 0, 0], sigma: 0.2}]}
  sog/best-2.0: {base: [{centre: [0.3, 0, 0], sigma: 0.3}], arm: [{centre: [0, 0, 0], sigma: 0.1}]}
"""


@pytest.fixture
def read(tmp_path: Path, linkage_text: str):
    def described(more: str) -> BodyDescription:
        file = tmp_path / "template.yaml"
        file.write_text(linkage_text + more)
        return Document.read(file).validated(BodyDescription)

    return described


def sog(tuned: str | None = None, kind: str = "sog") -> ListedShapeModel:
    made = ShapeModel.load(kind)(tuned=tuned)
    assert isinstance(made, ListedShapeModel)
    return made


@pytest.mark.parametrize(
    ("tuned", "sigmas"), [(None, [0.2]), ("paper", [0.4]), ("best-2.0", [0.6, 0.2])]
)
def test_a_shape_model_takes_the_list_that_it_names(read, tuned, sigmas):
    bound = sog(tuned).bind(read(LISTS).body("thing", 2.0))
    np.testing.assert_allclose(bound.scales[:, 0], sigmas)


def test_without_a_list_of_the_kind_alone_the_capsules_are_taken(read):
    body = read(LISTS.replace("  sog:", "  sog/other:")).body("thing", 1.0)
    assert sog().listed(body) is None
    assert len(sog().bind(body)) >= len(body.capsules)


@pytest.mark.parametrize(
    ("kind", "tuned", "held"),
    [("sog", "papr", "only paper, best-2.0"), ("gsog", "paper", "no named list")],
)
def test_a_list_that_the_template_lacks_is_told_with_those_that_it_has(read, kind, tuned, held):
    with pytest.raises(ConfigError) as caught:
        sog(tuned, kind).bind(read(LISTS).body("lamp", 1.0))
    told = str(caught.value)
    assert all(word in told for word in ("'lamp'", f"'{kind}/{tuned}'", held))


@pytest.mark.parametrize("key", ["sog/", "sog/a/b", "sog/-a", "sog/a b", "unheard/"])
def test_a_key_of_another_form_is_told_at_its_place(read, key):
    with pytest.raises(ConfigError, match=rf"template\.yaml:37: shapes\.{key}: .*KIND/NAME"):
        read(f"shapes: {{{key}: {{base: []}}}}\n")


@pytest.mark.parametrize("tuned", ["", "-a", "a/b", "a b"])
def test_only_the_name_of_a_list_can_be_named(tuned):
    with pytest.raises(ValidationError, match="tuned"):
        sog(tuned)


@pytest.mark.parametrize(
    ("wrong", "place"),
    [
        ("{base: [{centre: [0, 0, 0], sigma: -1}]}", r"shapes\.sog/a\.base\[0\]\.sigma"),
        ("{bse: [{centre: [0, 0, 0], sigma: 1}]}", r"shapes\.sog/a\.bse: .*'base'"),
    ],
)
def test_a_named_list_is_checked_by_the_class_of_its_kind(read, wrong, place):
    with pytest.raises(ConfigError, match=place):
        read(f"shapes: {{sog/a: {wrong}}}\n")


def test_a_named_list_of_a_kind_that_is_not_installed_is_kept_and_tells_its_key(read):
    description = read("shapes: {unheard/a: {base: [{width: 1}]}, sog: {}}\n")
    assert "no plug-in 'unheard'" in description.unchecked()["unheard/a"]
    assert set(description.body("thing", 1.0).shapes) == {"sog"}
    with pytest.raises(ConfigError, match=r"shapes\.unheard/a: "):
        description.check_shapes()


def test_named_lists_are_written_as_they_are_read(read, tmp_path):
    description = read(LISTS)
    again = tmp_path / "again.yaml"
    again.write_text(template_text(description, "Again.", {}))
    assert Document.read(again).validated(BodyDescription).shapes == description.shapes


def test_named_lists_are_stretched(read):
    description = read(LISTS)
    groups = Groups.of(description)
    factors = np.full(len(groups.names), 1.5)
    subject = Proportions(groups, factors, factors).applied(description)
    for key, listed in description.shapes.items():
        assert subject.shapes[key]["base"][0].sigma == pytest.approx(1.5 * listed["base"][0].sigma)
