"""Borders of a picture that cut the data off."""

import numpy as np
import pytest

from regkit.geometry.camera import Camera
from regkit.search.exemplars.borders import cutting_borders

CAMERA = Camera(width=60, height=40, fx=80.0, fy=80.0, cx=29.5, cy=19.5)


def borders(rows: slice, columns: slice) -> np.ndarray:
    depth = np.zeros((40, 60))
    depth[rows, columns] = 2.0
    return cutting_borders(CAMERA, depth, CAMERA.back_projected(depth))


def test_data_inside_the_picture_are_not_cut_off():
    assert borders(slice(5, 35), slice(5, 55)).shape == (0, 3)


@pytest.mark.parametrize(
    ("rows", "columns", "outward"),
    [
        (slice(10, 30), slice(30, 60), [1, 0]),
        (slice(10, 30), slice(0, 30), [-1, 0]),
        (slice(20, 40), slice(20, 40), [0, 1]),
        (slice(0, 20), slice(20, 40), [0, -1]),
    ],
)
def test_normals_of_borders_point_outward(rows, columns, outward):
    (normal,) = borders(rows, columns)
    assert np.linalg.norm(normal) == pytest.approx(1.0)
    assert (np.sign(np.round(normal[:2], 9)) == outward).all()
    depth = np.ones((40, 60))
    inside = CAMERA.back_projected(depth) @ normal
    assert inside.max() < 0.0
    assert inside.max() > -0.01


def test_longest_contact_comes_first():
    first, second = borders(slice(0, 30), slice(50, 60))
    assert first[0] > 0.0
    assert second[1] < 0.0
