"""``regkit.align_all``: many views in the frame of the first one."""

import numpy as np
import pytest

import regkit
from regkit.clouds import write_cloud
from regkit.geometry.rigid import inverse, rigid, transformed
from regkit.geometry.rotation import vector_to_matrix
from regkit.system.errors import ConfigError


@pytest.fixture
def motions():
    """T_world_view of three views, of the first the identity."""
    turns = ([0.0, 0.0, 0.0], [0.2, -0.1, 0.3], [-0.3, 0.2, 0.1])
    shifts = ([0.0, 0.0, 0.0], [0.2, 0.1, -0.1], [-0.1, 0.0, 0.3])
    return [
        rigid(vector_to_matrix(np.array(turn)), np.array(shift))
        for turn, shift in zip(turns, shifts, strict=True)
    ]


def test_views_are_placed_in_the_frame_of_the_first(lump, motions, tmp_path):
    views = [transformed(inverse(motion), lump) for motion in motions]
    write_cloud(tmp_path / "view.npz", views[0])
    found = regkit.align_all([tmp_path / "view.npz", *views[1:]], start="nearest")
    np.testing.assert_allclose(found.transforms, motions, atol=0.01)
    np.testing.assert_allclose(found.merged, np.tile(lump, (3, 1)), atol=0.02)
    assert found.verdict is regkit.Verdict.FOUND
    assert found.rows()["views"].startswith("3 of 3")
    found.save(tmp_path / "merged.npz")
    assert (tmp_path / "merged.npz").exists()


def test_one_view_is_refused(lump):
    with pytest.raises(ConfigError, match="1 views; at least two are needed"):
        regkit.align_all([lump])


def test_views_are_not_deformed(lump):
    with pytest.raises(ConfigError, match="choose a rigid method"):
        regkit.align_all([lump, lump + 0.05], "nonrigid", start="nearest")
