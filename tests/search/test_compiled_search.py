"""Compiled comparisons of limbs with points: equal to plain array expressions."""

import numpy as np
import pytest
from scipy.spatial import KDTree

from regkit.clouds.compiled_nearest import nearest_distances
from regkit.geometry.capsules import Capsules
from regkit.search.compiled import mean_gaps, unexplained


@pytest.mark.parametrize("most", [np.inf, 0.4, 0.0])
def test_nearest_distances_are_those_of_a_tree(random, most):
    queries, points = random.normal(size=(70, 3)), random.normal(size=(300, 3))
    found = nearest_distances(queries, points, most)
    expected = KDTree(points).query(queries)[0]
    np.testing.assert_allclose(np.minimum(found, most), np.minimum(expected, most), rtol=1e-12)


def test_distance_to_no_point_is_infinite(random):
    assert np.isinf(nearest_distances(random.normal(size=(4, 3)), np.zeros((0, 3)), np.inf)).all()


def test_mean_gaps_are_those_of_all_pairs(random):
    places, points = random.normal(size=(6, 3, 40)), random.normal(size=(9, 3))
    radii, most = random.uniform(0.05, 0.3, size=6), 0.5
    away = np.linalg.norm(places[:, :, :, None] - points.T[None, :, None, :], axis=1)
    gaps = np.minimum(np.abs(away - radii[:, None, None]).min(axis=0), most)
    expected = gaps.mean(axis=1) / most
    singles = [one.astype(np.float32) for one in (places, radii, points)]
    found = mean_gaps(*singles, np.float32(most))
    # Single precision rounds to 1e-7.
    np.testing.assert_allclose(found, expected, rtol=1e-5)


@pytest.mark.parametrize("count", [0, 1, 12])
def test_unexplained_points_are_in_the_ball_and_on_no_capsule(random, count):
    rest = Capsules(
        segments=np.zeros(count, dtype=np.intp),
        ends=random.normal(scale=0.5, size=(count, 2, 3)),
        radii=random.uniform(0.05, 0.3, size=(count, 2)),
    )
    points, centre = random.normal(scale=0.7, size=(500, 3)), np.array([0.1, -0.2, 0.0])
    found = unexplained(points, centre, 0.9, rest.ends, rest.radii, 0.1)
    inside = np.linalg.norm(points - centre, axis=1) < 0.9
    expected = np.flatnonzero(inside & (rest.surface_distance(points) > 0.1))
    assert len(expected) > 20
    np.testing.assert_array_equal(found, expected)
