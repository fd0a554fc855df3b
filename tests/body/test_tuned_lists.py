"""Lists of primitives in a file of their own."""

import numpy as np
import pytest

from regkit import load_template
from regkit.body import GaussianParameters, Mirror
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
        *(("best", {"tuned": name}) for name in ("best", "best_26", "best_41")),
        ("spheres", {"tuned": "spheres"}),
    ):
        method = Method.parse({"preset": name, "shape": shape}, place="test", field="method")
        plain = Method.parse({"preset": name}, place="test", field="method")
        tuned, before = method.bind(body).primitives, plain.bind(body).primitives
        assert set(tuned.segments) >= set(before.segments)


def other_side(name):
    sides = {"left": "right", "right": "left"}
    return "_".join(sides.get(part, part) for part in name.split("_"))


def difference(one, other):
    moments = zip(one.moments(), other.moments(), strict=True)
    return max(float(np.abs(own - its).max()) for own, its in moments)


NUMBERS = {
    "gsog/best": 13,
    "gsog/best_26": 26,
    "gsog/best_41": 41,
    "gsog/paper_exact": 13,
    "sog/paper_exact": 58,
    "sphere/spheres": 41,
}
"""Number of primitives of each shipped list."""


@pytest.mark.parametrize("build", ["average", "small", "tall"])
def test_shipped_lists_have_the_announced_number_and_are_mirror_images(build):
    shapes = load_template("human", build=build).description().shapes
    assert {key for key in shapes if "/" in key} == set(NUMBERS)
    for key, number in NUMBERS.items():
        listed = shapes[key]
        assert sum(map(len, listed.values())) == number
        for name, own in listed.items():
            others = listed[other_side(name)]
            for image in (one.deformed(Mirror()) for one in own):
                nearest = min(others, key=lambda other, image=image: difference(image, other))
                # Files have four decimals, and tenths of degrees; the template's own capsules
                # across the middle are not quite level.
                gaussian = isinstance(image, GaussianParameters)
                assert difference(image, nearest) < (3e-4 if gaussian else 1e-3)
                if gaussian:
                    assert image.weight == pytest.approx(nearest.weight, abs=2e-4)


def test_hands_have_a_list_of_48_and_the_left_is_the_mirror_image_of_the_right():
    left, right = (load_template("hand", side=side).description() for side in ("left", "right"))
    assert {key for key in right.shapes if "/" in key} == {"gsog/best_48"}
    listed, others = (one.shapes["gsog/best_48"] for one in (right, left))
    assert sum(map(len, listed.values())) == 48
    assert set(listed) == set(right.shapes["gsog"])
    for name, own in listed.items():
        for one, other in zip(own, others[name], strict=True):
            assert difference(one.deformed(Mirror()), other) < 1e-4
            assert one.weight == other.weight


def test_the_forearm_is_added_to_the_tuned_list_of_a_hand():
    shapes = load_template("hand", forearm=True).description().shapes
    assert shapes["gsog/best_48"]["forearm"] == shapes["gsog"]["forearm"]
