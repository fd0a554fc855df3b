"""Lists of primitives in a file of their own."""

import pytest

from regkit import load_template
from regkit.body.tuned_lists import TunedLists, tuned_lists_in
from regkit.interfaces import Method
from regkit.system.errors import ConfigError

LISTED = {
    "sources": ["gsog/thin: made for this test"],
    "shapes": {"gsog/thin": {"pelvis": [{"centre": [0, 0.1, 0], "sigma": [0.05, 0.1, 0.02]}]}},
}


def test_lists_are_read_as_they_are_written(tmp_path):
    lists = TunedLists.model_validate(LISTED)
    path = tmp_path / "lists.yaml"
    path.write_text(lists.text("A list."))
    assert tuned_lists_in(path) == lists


def test_template_has_its_own_lists_and_the_added_ones():
    description = load_template("human").description()
    added = TunedLists.model_validate(LISTED).added_to(description)
    assert added.shapes == {**description.shapes, **TunedLists.model_validate(LISTED).shapes}
    assert added.sources == (*description.sources, "gsog/thin: made for this test")


def test_list_of_an_unknown_field_is_told_at_its_line(tmp_path):
    path = tmp_path / "lists.yaml"
    path.write_text("sources: []\nshapes:\n  gsog/a:\n    pelvis:\n      - {centre: [0, 0, 0]}\n")
    with pytest.raises(ConfigError, match=r"lists.yaml:5: .*sigma"):
        tuned_lists_in(path)


@pytest.mark.parametrize("build", ["average", "small", "tall"])
def test_people_have_lists_for_the_methods_of_the_comparison(build):
    template = load_template("human", build=build)
    body = template.body(1.7)
    for name, shape in (
        ("paper_exact", {"kind": "gsog", "tuned": "paper_exact"}),
        ("paper_exact", {"kind": "sog", "tuned": "paper_exact"}),
        ("best", {"tuned": "best"}),
    ):
        method = Method.parse({"preset": name, "shape": shape}, place="test", field="method")
        plain = Method.parse({"preset": name}, place="test", field="method")
        tuned, before = method.bind(body).primitives, plain.bind(body).primitives
        assert set(tuned.segments) >= set(before.segments)
