"""Points inside capsules: all inside, evenly spread, and the same in each call."""

import numpy as np
import pytest

from regkit.geometry.capsule_moments import capsule_moments
from regkit.geometry.capsule_points import capsule_points, points_inside
from regkit.geometry.capsules import Capsules

ENDS = np.array([[0.1, 0.2, -0.1], [0.3, 0.1, 0.4]])


@pytest.mark.parametrize(
    ("ends", "radii"),
    [
        (ENDS, (0.1, 0.1)),
        (ENDS, (0.05, 0.12)),
        (ENDS, (0.9, 0.1)),
        (ENDS, (1e-3, 1e-3)),
        (ENDS[[0, 0]], (0.1, 0.1)),
    ],
)
def test_points_inside_a_capsule_have_its_moments(ends, radii):
    points = capsule_points(ends, np.array(radii), 2000)
    centre, axes, deviations = capsule_moments(ends, np.array(radii))
    size = np.linalg.norm(deviations)
    assert 1000 < len(points) < 8000
    np.testing.assert_allclose(points.mean(axis=0), centre, atol=0.03 * size)
    spread = axes * deviations**2 @ axes.T
    np.testing.assert_allclose(np.cov(points.T), spread, atol=0.05 * size**2)
    np.testing.assert_array_equal(points, capsule_points(ends, np.array(radii), 2000))


def test_points_are_inside_the_union_and_as_dense_where_capsules_overlap(random):
    other = np.add(ENDS, [0.02, 0.0, 0.01])
    union = Capsules(np.zeros(2, dtype=np.intp), np.array([ENDS, other]), np.full((2, 2), 0.1))
    points = points_inside(union, 0.01)
    assert (union.surface_distance(points) < 0.0).all()
    inside = random.uniform(points.min(axis=0), points.max(axis=0), size=(40000, 3))
    inside = inside[union.surface_distance(inside) < 0.0]
    np.testing.assert_allclose(np.cov(points.T), np.cov(inside.T), atol=5e-4)
