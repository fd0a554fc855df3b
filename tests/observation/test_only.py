"""A part of preprocessed data: its points, and pixels that are free or unknown."""

import numpy as np
import pytest

from regkit.geometry.camera import Camera
from regkit.geometry.rigid import rigid
from regkit.observation import Frame, Observation, View
from regkit.system.errors import DataError
from regkit_plugins.preprocessors.points import PointsPreprocessor

CAMERA = Camera(width=60, height=40, fx=60.0, fy=60.0, cx=29.5, cy=19.5)


@pytest.fixture
def seen() -> Observation:
    """A near square on the left and a far one on the right."""
    depth = np.zeros((40, 60))
    depth[10:30, 5:25] = 1.0
    depth[10:30, 35:55] = 1.5
    frame = Frame(CAMERA.back_projected(depth), CAMERA, depth)
    return PointsPreprocessor(voxel=0.05, sigma=0.02, normals=8).preprocess(frame)


def test_pixels_before_the_kept_points_are_unknown_and_others_free(seen) -> None:
    near = seen.points[:, 2] < 1.2
    far, close = seen.only(~near), seen.only(near)
    assert np.isnan(far.depth[10:30, 5:25]).all()
    assert (far.depth[10:30, 35:55] == 1.5).all()
    assert (close.depth[10:30, 35:55] == 0.0).all()
    assert (close.depth[10:30, 5:25] == 1.0).all()


def test_all_points_are_the_data_themselves(seen) -> None:
    whole = seen.only(np.ones(len(seen.points), dtype=bool))
    assert whole.depth is seen.depth
    np.testing.assert_array_equal(whole.points, seen.points)


def test_every_array_is_that_of_the_kept_points(seen) -> None:
    kept = np.arange(len(seen.points)) % 3 == 0
    left = seen.only(kept)
    for name in ("points", "weights", "variances", "normals"):
        np.testing.assert_array_equal(getattr(left, name), getattr(seen, name)[kept])


def test_views_lose_their_own_points(seen) -> None:
    moved = View("b", rigid(np.eye(3), np.array([1.0, 0.0, 0.0])), seen)
    both = Observation.of_views([View("a", np.eye(4), seen), moved])
    kept = both.points[:, 2] < 1.2
    left = both.only(kept)
    np.testing.assert_allclose(left.points, both.points[kept])
    assert len(left.views) == 2
    first = np.arange(len(both.points)) < len(seen.points)
    only = both.only(first & kept)
    np.testing.assert_allclose(only.points, both.points[first & kept])
    with pytest.raises(DataError, match="no camera has data"):
        both.only(np.zeros(len(both.points), dtype=bool))
