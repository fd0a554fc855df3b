"""Atlases of exemplars: made of the template alone, and kept."""

from dataclasses import fields

import numpy as np
import pytest
from lamp import LAMP, facing, seen

from regkit.body import Body, BodyDescription
from regkit.config.document import Document
from regkit.search.exemplars import Atlas, AtlasSettings, Finder, Pictures, atlas_of, storage
from regkit.system.notes import RegkitWarning

SETTINGS = AtlasSettings(count=1500)


@pytest.fixture(scope="module")
def description(tmp_path_factory) -> BodyDescription:
    path = tmp_path_factory.mktemp("lamp") / "lamp.yaml"
    path.write_text(LAMP)
    return Document.read(path).validated(BodyDescription)


@pytest.fixture(scope="module")
def lamp(description) -> Body:
    return description.body("lamp", 1.0)


@pytest.fixture(scope="module")
def atlas(lamp) -> Atlas:
    return Atlas.of(lamp, SETTINGS)


@pytest.fixture
def cache(monkeypatch, tmp_path):
    """An empty cache, on disk and in memory."""
    monkeypatch.setenv("REGKIT_CACHE", str(tmp_path))
    monkeypatch.setattr(storage, "_REMEMBERED", {})
    return tmp_path / "atlases"


def same(one: Atlas, two: Atlas) -> bool:
    return all(
        np.array_equal(getattr(one, field.name), getattr(two, field.name)) for field in fields(one)
    )


def test_atlas_of_all_sizes_is_one_file(cache, description, atlas):
    for size in (1.0, 0.87, 1.2):
        assert same(atlas_of(description.body("lamp", size), SETTINGS), atlas)
    assert len(list(cache.glob("*.npz"))) == 1


def test_stored_atlas_is_read_again(cache, lamp, monkeypatch):
    made = atlas_of(lamp, SETTINGS)
    monkeypatch.setattr(storage, "_REMEMBERED", {})
    monkeypatch.setattr(Atlas, "of", None)
    assert same(atlas_of(lamp, SETTINGS), made)


def test_damaged_atlas_is_told_and_made_again(cache, lamp, monkeypatch):
    made = atlas_of(lamp, SETTINGS)
    (file,) = cache.glob("*.npz")
    file.write_bytes(file.read_bytes()[:1000])
    monkeypatch.setattr(storage, "_REMEMBERED", {})
    with pytest.warns(RegkitWarning, match="made again"):
        assert same(atlas_of(lamp, SETTINGS), made)


def test_poses_of_an_atlas_are_within_the_limits(lamp, atlas):
    low, high = lamp.skeleton.limits.hinge.T
    assert (atlas.hinges >= low - 1e-6).all()
    assert (atlas.hinges <= high + 1e-6).all()


@pytest.mark.parametrize("image", [True, False], ids=["image", "points of a camera"])
@pytest.mark.parametrize(("heading", "roll"), [(0.0, 0.0), (2.0, 2.5), (4.0, 0.0)])
def test_body_is_among_the_candidates_from_any_side(lamp, atlas, heading, roll, image):
    pose = facing(lamp, heading, {"arm": 15.0, "head": -70.0})
    turn = np.eye(4)
    turn[:2, :2] = [[np.cos(roll), -np.sin(roll)], [np.sin(roll), np.cos(roll)]]
    pose = type(pose)(turn @ pose.root, pose.balls, pose.hinges)
    rolls = np.linspace(-np.pi, np.pi, 24, endpoint=False)
    finder = Finder([lamp], atlas, rolls, looked_up=200, kept=10)
    pictures = Pictures.of(seen(lamp, pose, image=image), lamp.size)
    expected = lamp.markers.place(lamp.place(pose).transforms)
    gaps = [
        np.linalg.norm(
            lamp.markers.place(lamp.place(one.pose).transforms) - expected, axis=1
        ).mean()
        for one in finder.candidates(pictures)
    ]
    assert min(gaps) < 0.06
