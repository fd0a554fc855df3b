"""Pixels that something may hide the body behind are neither free nor occupied."""

import numpy as np
import pytest

from regkit.observation import Frame, Silhouette
from regkit.observation.crop import Crop
from regkit.testing.samples import CAMERA

SHAPE = (CAMERA.height, CAMERA.width)


def image(*boxes: tuple[slice, slice, float]) -> Frame:
    """Returns the depth image of boxes (rows, columns, depth)."""
    depth = np.zeros(SHAPE)
    for rows, columns, value in boxes:
        depth[rows, columns] = value
    return Frame(CAMERA.back_projected(depth), CAMERA, depth, "an image")


TABLE = (slice(90, 120), slice(0, 176), 1.0)
BODY = (slice(20, 90), slice(60, 100), 2.0)
WALL = (slice(0, 20), slice(0, 176), 3.0)


def test_what_is_removed_before_the_body_is_unknown_and_behind_it_free():
    frame = image(TABLE, BODY, WALL)
    left = frame.only(frame.points[:, 2] == 2.0)
    assert np.isnan(left.depth[TABLE[:2]]).all()
    assert (left.depth[WALL[:2]] == 0.0).all()
    assert (left.depth[BODY[:2]] == 2.0).all()
    np.testing.assert_array_equal(left.depth.flat[left.pixels], left.points[:, 2])
    assert frame.only(np.ones(len(frame.points), dtype=bool)) is frame


@pytest.mark.parametrize("share", [0.0, 0.3, 0.9])
@pytest.mark.parametrize("floor", [False, True])
def test_removed_pixels_are_unknown_before_the_farthest_kept_one(random, share, floor):
    depth = np.where(random.uniform(size=SHAPE) < 0.7, random.uniform(1.0, 3.0, size=SHAPE), 0.0)
    depth[:9] = np.nan
    points = CAMERA.back_projected(depth)
    kept = (random.uniform(size=len(points)) < share) & (points[:, 2] < 2.2)
    free = random.uniform(size=len(points)) < 0.4 if floor else np.zeros(len(points), dtype=bool)
    left = Frame(points, CAMERA, depth).only(kept, free=free if floor else None)
    np.testing.assert_array_equal(left.points, points[kept])
    farthest = np.percentile(points[kept, 2], 98.0) if kept.any() else 0.0
    expected = depth.copy()
    hiding = ~kept & ~free & (points[:, 2] < farthest)
    expected[depth > 0.0] = np.where(kept, points[:, 2], np.where(hiding, np.nan, 0.0))
    np.testing.assert_array_equal(left.depth, expected)


def test_image_of_other_points_is_left_as_it_is(random):
    frame = image(BODY)
    for points in (frame.points[1:], np.concatenate([frame.points, frame.points[:1]])):
        other = Frame(points, CAMERA, frame.depth)
        left = other.only(np.arange(len(points)) < 5)
        np.testing.assert_array_equal(left.points, points[:5])
        np.testing.assert_array_equal(left.depth, frame.depth)


def test_what_cannot_hide_the_body_is_free():
    frame = image(TABLE, BODY)
    kept = frame.points[:, 2] == 2.0
    assert not np.isnan(frame.only(kept, free=~kept).depth).any()


def test_crop_leaves_unknown_what_is_nearer_than_near_alone():
    left = Crop(near=1.5, far=2.5).cropped(image(TABLE, BODY, WALL))
    assert np.isnan(left.depth[TABLE[:2]]).all()
    assert (left.depth[WALL[:2]] == 0.0).all()


def test_body_is_not_kept_out_of_unknown_blocks():
    frame = image(TABLE, BODY)
    left = frame.only(frame.points[:, 2] == 2.0)
    free = frame.only(frame.points[:, 2] == 2.0, free=frame.points[:, 2] == 1.0)
    # Below the body behind the table; beside the body; before the body; on it.
    pixels = np.array([[80.0, 105.0], [20.0, 50.0], [80.0, 50.0], [80.0, 50.0]])
    depths = np.array([2.0, 2.0, 1.5, 2.1])
    principal, focal = (CAMERA.cx, CAMERA.cy), (CAMERA.fx, CAMERA.fy)
    points = np.column_stack([(pixels - principal) / focal * depths[:, None], depths])
    known, _ = Silhouette(CAMERA, free.depth).distances(points, np.zeros(4))
    unknown, gradients = Silhouette(CAMERA, left.depth).distances(points, np.zeros(4))
    assert known[0] > 0.1
    assert unknown[0] == 0.0
    assert not gradients[0].any()
    np.testing.assert_allclose(unknown[1:], known[1:])
    assert unknown[1] > 0.1
    assert unknown[2] == pytest.approx(0.5)
    assert unknown[3] == 0.0
