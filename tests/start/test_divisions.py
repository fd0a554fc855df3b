"""Divisions of a cloud among several bodies."""

import numpy as np
import pytest

from regkit.start.divisions import divisions


def sheet(middle: list[float], width: float, height: float, step: float = 0.01) -> np.ndarray:
    """Points (N, 3) [m] on a rectangle that faces the camera."""
    x, y = np.meshgrid(np.arange(-width, width, step), np.arange(-height, height, step))
    return np.column_stack([x.ravel(), y.ravel(), np.zeros(x.size)]) + middle


def labels(division, count: int) -> np.ndarray:
    """The number of the part of each point, (N,); -1 of none."""
    found = np.full(count, -1)
    for number, part in enumerate(division.parts):
        found[part] = number
    return found


def test_pieces_come_first_and_are_not_cut() -> None:
    points = np.concatenate([sheet([-0.2, 0, 1], 0.1, 0.05), sheet([0.2, 0, 1], 0.08, 0.05)])
    first = next(divisions(points, 2))
    assert not first.cut
    left = points[:, 0] < 0.0
    np.testing.assert_array_equal(first.parts[0], left)
    np.testing.assert_array_equal(first.parts[1], ~left)


def test_a_piece_before_others_leaves_them_together() -> None:
    """Two fragments on both sides of a larger piece that hides what is between them."""
    before = sheet([0, 0, 0.8], 0.08, 0.15)
    fragments = [sheet([x, 0, 1], 0.04, 0.05) for x in (-0.2, 0.2)]
    points = np.concatenate([before, *fragments])
    pieces, rest, *_ = divisions(points, 2)
    assert len(pieces.parts) == 3
    assert rest.cut
    np.testing.assert_array_equal(rest.parts[0], points[:, 2] < 0.9)
    np.testing.assert_array_equal(rest.parts[1], points[:, 2] > 0.9)


def test_a_cut_goes_where_the_points_are_least_connected() -> None:
    """Through the bridge of two sheets, however unlike they are."""
    large, small = sheet([-0.15, 0, 1], 0.1, 0.1), sheet([0.1, 0, 1], 0.05, 0.05)
    bridge = sheet([0, 0, 1], 0.06, 0.005)
    points = np.unique(np.concatenate([large, bridge, small]).round(4), axis=0)
    first = next(divisions(points, 2))
    assert first.cut
    own = labels(first, len(points))
    for side in (points[:, 0] < -0.06, points[:, 0] > 0.06):
        assert len(np.unique(own[side])) == 1
    assert set(own) == {0, 1}


@pytest.mark.parametrize("count", [2, 3])
def test_every_division_has_as_many_parts_as_bodies_at_least(random, count) -> None:
    points = random.normal(size=(400, 3))
    for division in divisions(points, count):
        assert len(division.parts) >= count
        assert not np.sum(division.parts, axis=0).max() > 1


def test_the_order_of_points_does_not_matter(random) -> None:
    points = np.concatenate([sheet([-0.2, 0, 1], 0.1, 0.05), sheet([0.2, 0, 1], 0.08, 0.05)])
    order = random.permutation(len(points))
    for one, other in zip(divisions(points, 2), divisions(points[order], 2), strict=True):
        same = labels(one, len(points))[order], labels(other, len(points))
        parts = [{frozenset(np.flatnonzero(of == at)) for at in set(of)} for of in same]
        if not one.cut:
            assert parts[0] == parts[1]
