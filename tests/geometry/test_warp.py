"""Displacements that follow those of given points."""

import numpy as np
import pytest

from regkit.geometry.warp import Warp


def warp_of(matrix: np.ndarray, shift: np.ndarray, count: int = 60) -> Warp:
    random = np.random.default_rng(0)
    points = random.normal(size=(count, 3))
    displaced = points @ matrix.T + shift - points
    return Warp(points, displaced, random.uniform(0.5, 2.0, count), 0.3)


def test_warp_reproduces_affine_displacements():
    matrix = np.array([[1.2, 0.1, 0.0], [0.0, 0.9, 0.2], [-0.1, 0.0, 1.1]])
    shift = np.array([0.1, -0.2, 0.3])
    warp = warp_of(matrix, shift)
    for point in np.random.default_rng(1).normal(size=(5, 3)):
        image, around = warp.at(point)
        # The undeformed map has a weight of a thousandth.
        np.testing.assert_allclose(image, matrix @ point + shift, atol=2e-3)
        np.testing.assert_allclose(around, matrix, atol=2e-3)


def test_warp_moves_what_lies_at_a_heavy_point_with_it():
    warp = warp_of(np.eye(3), np.zeros(3))
    heavy = Warp(
        np.concatenate([warp.points, [[0.2, 0.2, 0.2]]]),
        np.concatenate([warp.displacements, [[0.05, 0.0, 0.0]]]),
        np.concatenate([warp.weights, [1e6]]),
        0.01,
    )
    image, _ = heavy.at(np.array([0.2, 0.2, 0.2]))
    np.testing.assert_allclose(image, [0.25, 0.2, 0.2], atol=1e-4)


@pytest.mark.parametrize("count", [0, 1, 2, 3])
def test_warp_of_few_points_translates(count):
    points = np.random.default_rng(2).normal(size=(count, 3))
    shift = np.array([0.1, 0.0, -0.1])
    warp = Warp(points, np.tile(shift, (count, 1)), np.ones(count), 0.1)
    image, around = warp.at(np.array([0.3, 0.2, 0.1]))
    moved = shift if count else 0.0 * shift
    np.testing.assert_allclose(image, np.array([0.3, 0.2, 0.1]) + moved, atol=1e-9)
    np.testing.assert_allclose(around, np.eye(3), atol=1e-9)
