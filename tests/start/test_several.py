"""The start of several bodies beside each other: each on its own points, and all together."""

from pathlib import Path

import numpy as np
import pytest
from pole_and_ball import APART, pole_and_ball, seen, template

from regkit.body.verdict import Verdict
from regkit.interfaces import Start, StartSearch, Template
from regkit.observation import Observation
from regkit.start.divisions import divisions
from regkit.system.errors import ConfigError
from regkit.system.notes import RegkitWarning
from regkit.tracking.extent import check_extent

SEARCH = {"kind": "exemplars", "exemplars": 400, "looked_up": 60, "refined": 10, "finalists": 2}


def search(kind: str = "exemplars") -> StartSearch:
    return StartSearch.parse(SEARCH if kind == "exemplars" else kind, place="test", field="start")


@pytest.fixture
def files(tmp_path: Path) -> dict[str, dict[str, object]]:
    return pole_and_ball(tmp_path)


def marked(start: Start) -> dict[str, np.ndarray]:
    """The places of the markers by name."""
    places = start.body.markers.place(start.body.place(start.pose).transforms)
    return dict(zip(start.body.markers.names, places, strict=True))


@pytest.mark.parametrize("kind", ["exemplars", "stances"])
def test_bodies_apart_are_found(files, kind) -> None:
    observation, body, truth = seen(template(files), *APART)
    start = search(kind).find(template(files), [observation])
    expected = marked(Start(body, truth))
    assert start.verdict is Verdict.FOUND, start.reason
    for name, place in marked(start).items():
        assert np.linalg.norm(place - expected[name]) < 0.03, name


def test_a_start_of_bodies_apart_is_that_of_each_alone(files) -> None:
    """Searched on the points of its piece."""
    observation, _, _ = seen(template(files), *APART)
    both = marked(search().find(template(files), [observation]))
    left = observation.points[:, 0] < 0.0
    for name, own in (("pole", left), ("ball", ~left)):
        one = Template.parse(files[name], place="test", field="template")
        alone = marked(search().find(one, [observation.only(own)]))
        for marker, place in alone.items():
            np.testing.assert_allclose(both[f"{name}_{marker}"], place, atol=0.02)


def test_names_and_their_order_do_not_matter(files) -> None:
    observation, _, _ = seen(template(files), *APART)
    start = marked(search().find(template(files), [observation]))
    renamed = {"z": files["ball"], "a": files["pole"]}
    other = marked(search().find(template(renamed), [observation]))
    names = {"pole": "a", "ball": "z"}
    for name, place in start.items():
        part, marker = name.split("_", 1)
        np.testing.assert_allclose(other[f"{names[part]}_{marker}"], place, atol=1e-5)


def test_touching_bodies_are_told_apart(files) -> None:
    """The ball lies at the pole's foot: there is one piece."""
    observation, body, truth = seen(template(files), [0.0, 0.0, 2.4], [0.13, 0.4, 2.4])
    first = next(divisions(observation.points, 2))
    assert first.cut
    start = search().find(template(files), [observation])
    expected = marked(Start(body, truth))
    for name in ("pole_foot", "ball_middle"):
        assert np.linalg.norm(marked(start)[name] - expected[name]) < 0.03, name


@pytest.mark.parametrize("missing", ["ball", "pole"])
def test_a_body_without_points_is_not_found(files, missing) -> None:
    """It is told by its name, wherever it is put."""
    places = {"pole": APART[0], "ball": APART[1]}
    places[missing] = [0.0, 0.0, -5.0]
    observation, _, _ = seen(template(files), places["pole"], places["ball"])
    start = search().find(template(files), [observation])
    assert start.verdict is not Verdict.FOUND
    assert f"{missing}:" in start.reason


def test_too_few_points_are_no_bodies(files) -> None:
    observation, _, _ = seen(template(files), *APART)
    few = observation.only(np.arange(len(observation.points)) < 15)
    start = search().find(template(files), [few])
    assert start.verdict is Verdict.LOST
    assert "15 points" in start.reason


def test_a_body_that_the_method_does_not_know_is_refused(files, tmp_path, lump) -> None:
    """A cloud has no capsules, of which the default method makes its primitives."""
    np.savetxt(tmp_path / "lump.xyz", lump)
    cloud = {"kind": "cloud", "path": str(tmp_path / "lump.xyz")}
    whole = template({"ball": files["ball"], "lump": cloud})
    observation = Observation(lump, np.ones(len(lump)), 1e-4 * np.ones(len(lump)))
    with pytest.raises(ConfigError, match="'lump' has no primitives"):
        search().find(whole, [observation])


def test_bodies_far_apart_are_of_no_unlikely_extent(files) -> None:
    """Nothing is told of the two, but of each alone in the same data."""
    observation, _, _ = seen(template(files), *APART)
    check_extent(observation.points, template(files), place="test")
    ball = Template.parse(files["ball"], place="test", field="template")
    with pytest.warns(RegkitWarning, match="spread over"):
        check_extent(observation.points, ball, place="test")


def test_a_body_that_is_mostly_hidden_is_doubtful(files) -> None:
    """The ball is behind the pole, but for a rim."""
    observation, _, _ = seen(template(files), [0.0, 0.0, 2.0], [0.0, 0.1, 2.6])
    start = search().find(template(files), [observation])
    assert start.verdict is not Verdict.FOUND
    assert "ball:" in start.reason
