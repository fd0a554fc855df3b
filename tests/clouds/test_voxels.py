"""Voxels of clouds: the compiled table gives what sorted voxel numbers give."""

import numpy as np
import pytest

from regkit.clouds import voxel_downsampled, voxel_for


def means(points, voxel):
    """The readable reference: sorts the voxels of all points."""
    cells, owner = np.unique(np.floor(points / voxel), axis=0, return_inverse=True)
    sums, counts = np.zeros((len(cells), 3)), np.zeros(len(cells))
    np.add.at(sums, owner.ravel(), points)
    np.add.at(counts, owner.ravel(), 1.0)
    return sums / counts[:, None]


def size(points, wanted):
    """The readable reference: bisects with all voxels counted."""
    extent = float(np.ptp(points, axis=0).max())
    lower, upper = 1e-6 * extent, extent
    for _ in range(12):
        middle = float(np.sqrt(lower * upper))
        many = len(np.unique(np.floor(points / middle), axis=0)) > wanted
        lower, upper = (middle, upper) if many else (lower, middle)
    return upper


def clouds():
    random = np.random.default_rng(3)
    ball = random.normal(size=(3000, 3))
    return {
        "around the origin": ball,
        "on a surface": ball / np.linalg.norm(ball, axis=1, keepdims=True),
        "with duplicates": ball[random.integers(300, size=3000)],
        "far away": ball + np.array([1e6, -3e6, 2e5]),
        "on a grid": np.round(4.0 * ball) / 4.0,
        "long": ball * [1e3, 1.0, 1e-3],
        "by columns": np.asfortranarray(ball),
    }


@pytest.mark.parametrize("name", clouds())
@pytest.mark.parametrize("wanted", [20, 200, 2999])
def test_voxel_size_is_that_of_counting_all(name, wanted):
    points = clouds()[name]
    assert voxel_for(points, wanted) == size(points, wanted)


@pytest.mark.parametrize("name", clouds())
@pytest.mark.parametrize("voxel", [1e-9, 0.01, 0.25, 1.0, 50.0])
def test_downsampled_cloud_is_that_of_sorted_voxels(name, voxel):
    points = clouds()[name]
    np.testing.assert_array_equal(voxel_downsampled(points, voxel), means(points, voxel))


def test_order_of_the_points_does_not_matter(random):
    points = random.normal(size=(2000, 3))
    shuffled = voxel_downsampled(random.permutation(points), 0.3)
    np.testing.assert_allclose(shuffled, voxel_downsampled(points, 0.3), rtol=1e-12, atol=1e-12)


def test_cloud_that_has_no_more_points_than_wanted_needs_no_voxel(random):
    points = random.normal(size=(50, 3))
    assert voxel_for(points, 50) is None
    assert voxel_for(points, 51) is None
    assert voxel_for(np.ones((100, 3)), 50) is None
