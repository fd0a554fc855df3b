"""How much of a cloud lies on planes."""

import numpy as np
import pytest

from regkit.clouds import planar_share


def on_a_box(random, count: int = 600) -> np.ndarray:
    """Points on two faces of a box, 0.5 m wide, with 2 mm of noise."""
    flat = random.uniform(-0.25, 0.25, size=(count, 2))
    front = np.column_stack([flat, np.zeros(count)])
    side = np.column_stack([np.full(count, 0.25), flat])
    return np.concatenate([front, side]) + 0.002 * random.normal(size=(2 * count, 3))


def test_two_faces_of_a_box_are_two_planes(random):
    points = on_a_box(random)
    assert planar_share(points, 0.01) > 0.95
    assert 0.4 < planar_share(points, 0.01, planes=1) < 0.65


def test_ball_is_no_plane(random):
    points = random.normal(size=(800, 3))
    points *= 0.3 / np.linalg.norm(points, axis=1, keepdims=True)
    assert planar_share(points, 0.01) < 0.4


def test_share_does_not_depend_on_the_frame(random):
    points = on_a_box(random)
    turned = points @ np.linalg.qr(random.normal(size=(3, 3)))[0] + [3.0, -2.0, 5.0]
    assert planar_share(turned, 0.01) == pytest.approx(planar_share(points, 0.01), abs=0.03)


@pytest.mark.parametrize("points", [np.zeros((0, 3)), np.ones((5, 3)), np.ones((50, 3))])
def test_points_without_extent_have_a_share(points):
    assert 0.0 <= planar_share(points, 0.01) <= 1.0
