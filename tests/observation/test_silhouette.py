"""What a depth image shows: free space, and what lies out of sight."""

import numpy as np
import pytest

from regkit.geometry.camera import Camera
from regkit.observation import Silhouette

CAMERA = Camera(width=88, height=66, fx=100.0, fy=100.0, cx=43.5, cy=32.5)


@pytest.fixture
def silhouette() -> Silhouette:
    """A wall 2 m away in the left half of the image, unknown pixels above on the right."""
    depth = np.zeros((66, 88))
    depth[:, :44] = 2.0
    depth[:20, 60:] = np.nan
    return Silhouette(CAMERA, depth)


def point(column: float, row: float, z: float) -> np.ndarray:
    return np.array([(column - CAMERA.cx) / CAMERA.fx * z, (row - CAMERA.cy) / CAMERA.fy * z, z])


@pytest.mark.parametrize("column", [-30.0, -2.0, 90.0, 300.0])
def test_nothing_beyond_the_picture_is_in_free_space(silhouette, column):
    points = point(column, 30.0, 1.5)[None]
    distances, gradients = silhouette.distances(points, np.zeros(1))
    assert not distances.any()
    assert not gradients.any()
    assert not silhouette.observable(points).any()


def test_free_space_is_observable(silhouette):
    points = np.stack([point(70.0, 50.0, 1.5), point(20.0, 50.0, 1.5)])
    assert (silhouette.distances(points, np.zeros(2))[0] > 0.0).all()
    assert silhouette.observable(points, 0.1).all()


def test_unknown_pixels_show_nothing(silhouette):
    points = np.stack([point(75.0, 8.0, z) for z in (0.5, 3.0)])
    assert not silhouette.observable(points).any()
    assert not silhouette.distances(points, np.zeros(2))[0].any()


def test_measured_surfaces_hide_what_is_farther_behind_them_than_the_margin(silhouette):
    points = np.stack([point(20.0, 30.0, z) for z in (1.9, 2.05, 2.2)])
    assert silhouette.observable(points, 0.1).tolist() == [True, True, False]
    assert silhouette.observable(points).all()


def test_nothing_behind_the_camera_is_observable(silhouette):
    assert not silhouette.observable(np.array([[0.0, 0.0, -1.0]])).any()
