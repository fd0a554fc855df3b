"""The k-d tree finds what a comparison of all pairs finds."""

import numpy as np
import pytest

from regkit.clouds import normals, spacing
from regkit.clouds.tree import LARGE, Tree
from regkit.system.threads import using_threads


def all_pairs(points, queries, count):
    """Distances of the nearest points, (Q, k)."""
    squares = ((queries[:, None] - points) ** 2).sum(axis=2)
    return np.sqrt(np.sort(squares, axis=1)[:, :count])


@pytest.mark.parametrize("count", [1, 2, 15, 17, 400])
@pytest.mark.parametrize("offset", [0.0, -1e6])
def test_nearest_points_are_those_of_all_pairs(random, count, offset):
    points, queries = random.normal(size=(count, 3)) + offset, random.normal(size=(60, 3)) + offset
    tree, near = Tree.of(points), min(count, 6)
    distances, places = tree.nearest(queries, near)
    np.testing.assert_array_equal(distances, all_pairs(points, queries, near))
    np.testing.assert_array_equal(
        np.linalg.norm(points[tree.order[places]] - queries[:, None], axis=2), distances
    )


def test_equal_points_are_all_found(random):
    points = np.repeat(random.normal(size=(30, 3)), 20, axis=0)
    distances, places = Tree.of(points).nearest(points[::20], 20)
    np.testing.assert_array_equal(distances, 0.0)
    assert all(len(set(row)) == 20 for row in places.tolist())


def test_points_beyond_the_distance_or_the_number_are_none(random):
    points, queries = random.normal(size=(200, 3)), 2.0 * random.normal(size=(50, 3))
    distances, places = Tree.of(points).nearest(queries, 5, 0.4)
    reference = all_pairs(points, queries, 5)
    np.testing.assert_array_equal(distances, np.where(reference < 0.4, reference, np.inf))
    np.testing.assert_array_equal(places == 200, reference >= 0.4)
    distances, places = Tree.of(points[:3]).nearest(queries, 5)
    assert np.isinf(distances[:, 3:]).all()
    assert (places[:, 3:] == 3).all()


def test_tree_holds_the_cloud_in_another_order(random):
    points = random.normal(size=(1000, 3))
    tree = Tree.of(points)
    np.testing.assert_array_equal(tree.points, points[tree.order])


def test_threads_change_no_bit(random):
    points = random.normal(size=(LARGE + 500, 3))

    def answers():
        tree = Tree.of(points)
        return tree.order, *tree.nearest(points[:5000], 4), normals(points), spacing(points)

    alone = answers()
    with using_threads(3):
        for one, several in zip(alone, answers(), strict=True):
            np.testing.assert_array_equal(one, several)


@pytest.mark.parametrize("shape", [(1.0, 1.0, 1.0), (1.0, 1.0, 1e-3), (1.0, 1e-3, 1e-3), (1, 0, 0)])
def test_normal_has_the_least_variance(random, shape):
    """Also of neighbourhoods without a plane, where a closed form is not exact."""
    points = random.normal(size=(300, 3)) * shape
    tree = Tree.of(points)
    around = tree.points[tree.nearest(points, 10)[1]]
    around -= around.mean(axis=1, keepdims=True)
    least = np.linalg.eigvalsh(np.swapaxes(around, 1, 2) @ around)[:, 0]
    found = ((around @ normals(points)[:, :, None])[:, :, 0] ** 2).sum(axis=1)
    total = (around**2).sum(axis=(1, 2))
    np.testing.assert_allclose(found / total, np.maximum(least, 0.0) / total, atol=1e-14)
