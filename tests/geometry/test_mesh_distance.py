"""Distances of points to a mesh."""

import numpy as np
import trimesh

from regkit.geometry.mesh_distance import mesh_distances


def test_distances_to_a_box_are_those_of_the_box():
    box = trimesh.creation.box((1.0, 2.0, 0.5)).subdivide_loop(0)
    for _ in range(3):
        box = box.subdivide()
    points = np.random.default_rng(0).uniform(-2.0, 2.0, size=(300, 3))
    half = np.array([0.5, 1.0, 0.25])
    beyond = np.abs(points) - half
    outside = np.linalg.norm(np.maximum(beyond, 0.0), axis=1)
    inside = -np.minimum(beyond.max(axis=1), 0.0)
    found = mesh_distances(points, np.asarray(box.vertices), np.asarray(box.faces))
    np.testing.assert_allclose(found, outside + inside, atol=1e-9)


def test_distance_to_a_single_triangle_is_known():
    corners = np.array([[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]])
    points = np.array([[0.2, 0.2, 0.3], [2.0, 0.0, 0.0], [0.5, 0.5, 0.0]])
    found = mesh_distances(points, corners, np.array([[0, 1, 2]]))
    np.testing.assert_allclose(found, [0.3, 1.0, 0.0], atol=1e-12)
