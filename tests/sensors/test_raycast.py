"""What a depth camera sees of meshes: exact depths, angles of incidence, and what hides what."""

from __future__ import annotations

import sys

import numpy as np
import pytest

from regkit.geometry.camera import Camera
from regkit.sensors import CAMERAS, RayCaster, View, nearest, ray_cast
from regkit.system.errors import DependencyError

SMALL = Camera(width=20, height=16, fx=20.0, fy=20.0, cx=9.5, cy=7.5)


def test_ray_cast_of_a_slanted_plane_is_exact():
    # The plane z = 2 + x / 2, larger than the image.
    corners = np.array([[-9, -9, -2.5], [3, -9, 3.5], [3, 9, 3.5], [-9, 9, -2.5]], dtype=float)
    depth = ray_cast(corners, np.array([[0, 1, 2], [0, 2, 3]]), SMALL)
    expected = 2.0 / (1.0 - SMALL.rays()[..., 0] / 2.0)
    assert np.allclose(depth, expected, atol=1e-12)


def test_ray_cast_sees_the_nearest_and_nothing_beside_it():
    far = np.array([[-9, -9, 4], [9, -9, 4], [0, 9, 4]], dtype=float)
    near = np.array([[-0.2, -0.2, 1], [0.2, -0.2, 1], [0, 0.2, 1]], dtype=float)
    both = np.concatenate([far, near])
    faces = np.arange(6).reshape(2, 3)
    assert ray_cast(both, faces, SMALL)[7, 10] == pytest.approx(1.0)
    assert ray_cast(both, faces, SMALL)[15, 0] == pytest.approx(4.0)
    assert ray_cast(near, faces[:1], SMALL)[15, 0] == 0.0


def test_missing_open3d_is_answered_with_the_command_to_install_it(monkeypatch):
    monkeypatch.setitem(sys.modules, "open3d", None)
    with pytest.raises(DependencyError, match="pip install open3d"):
        ray_cast(np.eye(3), np.array([[0, 1, 2]]), SMALL)


def test_view_of_a_slanted_plane_has_its_angle_of_incidence():
    camera = CAMERAS["sr4000"].camera()
    corners = np.array([[-9, -9, -2.5], [3, -9, 3.5], [3, 9, 3.5], [-9, 9, -2.5]], dtype=float)
    view = RayCaster(camera).view(corners, np.array([[0, 1, 2], [0, 2, 3]]))
    rays = camera.rays() / np.linalg.norm(camera.rays(), axis=2, keepdims=True)
    normal = np.array([0.5, 0.0, -1.0]) / np.sqrt(1.25)  # The plane is z = 2 + x / 2.
    assert np.allclose(view.cosines, np.abs(rays @ normal), atol=1e-6)


def test_view_is_that_of_the_whole_image_when_a_mesh_is_partly_behind_or_beside():
    camera = CAMERAS["sr4000"].camera()
    faces = np.array([[0, 1, 2]])
    beside = np.array([[5.0, 0, 2], [6, 0, 2], [5, 1, 2]])
    assert not RayCaster(camera).view(beside, faces).depth.any()
    through = np.array([[0.0, 0, -1], [0.3, 0.2, 4], [-0.3, 0.2, 4]])
    assert RayCaster(camera).view(through, faces).depth.any()


def test_nearest_of_several_views_is_seen():
    one = View(np.array([[0.0, 2.0, 3.0, 0.0]]), np.array([[1.0, 0.2, 0.3, 1.0]]))
    two = View(np.array([[4.0, 1.0, 3.0, 0.0]]), np.array([[0.5, 0.6, 0.7, 1.0]]))
    common, index = nearest([one, two])
    assert common.depth.tolist() == [[4.0, 1.0, 3.0, 0.0]]
    assert common.cosines.tolist() == [[0.5, 0.6, 0.3, 1.0]]
    assert index.tolist() == [[1, 1, 0, -1]]
