"""Variants of poses, and what the search gains by them."""

import numpy as np
import pytest
from lamp import LAMP, facing, seen

from regkit.search.exemplars import Atlas, AtlasSettings, Finder, Pictures, Variation
from regkit.search.exemplars.variation import varied
from regkit.search.limbs import limbs_of
from regkit_plugins.templates.file import FileTemplate
from regkit_plugins.templates.human import Human


@pytest.fixture(scope="module")
def person():
    return Human(height=1.7).body(1.7)


@pytest.fixture(scope="module")
def poses(person):
    return [stance.pose for stance in person.stances[:3]]


@pytest.fixture(scope="module")
def atlas(person):
    return Atlas.of(person, AtlasSettings(200))


def test_variants_exchange_one_or_two_limbs(person, poses, atlas):
    each = 40
    found = varied(person, atlas, poses, np.array([0, 0, 1]), each, np.random.default_rng(0))
    assert len(found) == each * len(poses)
    assert found.sizes.tolist() == [0] * 2 * each + [1] * each
    limbs = limbs_of(person)
    for index in range(len(found)):
        parent = poses[index // each]
        assert np.array_equal(found.roots[index], parent.root)
        changed = [
            not np.allclose(found.balls[index, limb.balls], parent.balls[limb.balls])
            or not np.allclose(found.hinges[index, limb.hinges], parent.hinges[limb.hinges])
            for limb in limbs
        ]
        assert sum(changed) <= 2


def test_variants_have_unit_quaternions(person, poses, atlas):
    found = varied(person, atlas, poses, np.zeros(3, int), 20, np.random.default_rng(1))
    assert np.allclose(np.linalg.norm(found.balls, axis=2), 1.0, atol=1e-5)


def test_variation_finds_what_agrees_better(tmp_path):
    path = tmp_path / "lamp.yaml"
    path.write_text(LAMP)
    lamp = FileTemplate(path=path).body(1.0)
    atlas = Atlas.of(lamp, AtlasSettings(100))
    pictures = Pictures.of(seen(lamp, facing(lamp, 1.0, {"arm": 25.0, "head": -75.0})), 1.0)
    least = []
    for rounds in (0, 4):
        variation = Variation(rounds, poses=4, each=40, kept=6)
        finder = Finder([lamp], atlas, np.zeros(1), 20, 3, variation=variation)
        found = [one.disagreement for one in finder.candidates(pictures)]
        assert found == sorted(found)
        least.append(found[0])
    assert least[1] <= least[0]
