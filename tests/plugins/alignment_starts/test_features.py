"""Matched features: any orientation, views of one side, and what contradicts a motion."""

import numpy as np
import pytest

from regkit.geometry.rigid import inverse, rigid, transformed
from regkit.geometry.rotation import from_matrix, to_vector, vector_to_matrix
from regkit.interfaces import AlignmentStart, Method
from regkit_plugins.alignment_starts.features.compiled_scores import scores
from regkit_plugins.alignment_starts.features.orientation import oriented
from regkit_plugins.alignment_starts.features.prepared import Prepared, Surface


@pytest.fixture
def dense(random):
    """A closed surface without symmetries, and its normals."""
    unit = random.normal(size=(12_000, 3))
    unit /= np.linalg.norm(unit, axis=1, keepdims=True)
    x, y, z = unit.T
    radii = 1.0 + 0.3 * np.sin(5.0 * x + 1.0) * y + 0.3 * np.cos(4.0 * z) * x + 0.2 * y * z
    return radii[:, None] * unit


def view(points, direction):
    """The points that a camera far away in a direction sees: those in front of each pixel."""
    other = np.cross(direction, [0.3, 1.0, 0.2])
    other /= np.linalg.norm(other)
    pixels = np.floor(points @ np.column_stack([other, np.cross(direction, other)]) / 0.08)
    _, owner = np.unique(pixels, axis=0, return_inverse=True)
    heights = points @ direction
    front = np.full(owner.max() + 1, -np.inf)
    np.maximum.at(front, owner.ravel(), heights)
    return points[heights > front[owner.ravel()] - 0.12]


def found(source, target, **options):
    start = AlignmentStart.parse({"kind": "features", **options}, place="test", field="start")
    method = Method.parse(Method.default("rigid"), place="test", field="method")
    return start.candidates(source, target, method)


def degrees(transform, truth):
    change = (inverse(truth) @ transform)[:3, :3]
    return float(np.degrees(np.linalg.norm(to_vector(from_matrix(change)))))


@pytest.mark.parametrize("turn", [[0.0, 0.1, 0.0], [3.0, 0.4, 0.0], [-1.0, 1.5, 2.0]])
def test_views_of_two_sides_are_brought_together(dense, turn):
    truth = rigid(vector_to_matrix(np.array(turn)), np.array([5.0, -2.0, 1.0]))
    sides = [np.array([np.sin(a), 0.0, np.cos(a)]) for a in (0.0, np.radians(60.0))]
    source, target = (view(dense, side) for side in sides)
    first = found(source, transformed(truth, target))[0]
    assert degrees(first.transform, truth) < 5.0
    assert 0.1 < first.overlap < 0.9


def test_view_is_recognised_and_its_normals_face_the_camera(dense):
    direction = np.array([1.0, 2.0, -1.0]) / np.sqrt(6.0)
    surface = Surface.of(view(dense, direction)[::4])
    normals, camera = oriented(surface.tree.points, surface.normals, 0.08)
    assert camera is not None
    assert camera @ direction > 0.85
    assert np.mean(normals @ direction > -0.1) > 0.95
    assert oriented(*whole(dense), 0.08)[1] is None


def whole(dense):
    surface = Surface.of(dense[::4])
    return surface.tree.points, surface.normals


def test_normals_of_a_convex_surface_point_outward(dense):
    unit = dense / np.linalg.norm(dense, axis=1, keepdims=True)
    points, normals = whole(unit * [1.0, 0.7, 0.4])
    outer, view = oriented(points, normals, 0.06)
    assert view is None
    assert ((outer * points).sum(axis=1) > 0.0).all()


def test_points_in_free_space_contradict_a_motion(dense):
    direction = np.array([0.0, 0.0, 1.0])
    seen = Prepared.of(Surface.of(view(dense, direction)), 0.1, 0.5)
    assert seen.around.seen
    every = (seen.around.points, seen.around.normals) * 2
    shift = np.zeros((3, 3, 4))
    shift[:, :, :3] = np.eye(3)
    shift[1, 2, 3] = 1.0
    shift[2, 0, 3] = 1.0
    overlap, against = scores(shift, seen.around, seen.around, every, 0.15).T
    assert overlap[0] > 0.9
    assert against[0] == 0.0
    # In front of the surface and beside the silhouette nothing was seen.
    assert (overlap[1:] < 0.4).all()
    assert (against[1:] > 0.15).all()


def test_common_units_change_nothing(dense):
    truth = rigid(vector_to_matrix(np.array([2.0, 1.0, 0.0])), np.ones(3))
    cloud = dense[:4000]
    small = found(cloud, transformed(truth, cloud))[0]
    large = found(1000.0 * cloud, 1000.0 * transformed(truth, cloud))[0]
    assert degrees(small.transform, truth) < 1.0
    assert degrees(large.transform, small.transform) < 0.1
    np.testing.assert_allclose(large.accuracy, 1000.0 * small.accuracy, rtol=1e-3)
