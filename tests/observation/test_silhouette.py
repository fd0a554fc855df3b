"""What a depth image shows: free space, and what lies out of sight."""

import numpy as np
import pytest

from regkit.geometry.camera import Camera
from regkit.observation import Silhouette

CAMERA = Camera(width=88, height=66, fx=100.0, fy=100.0, cx=43.5, cy=32.5)


@pytest.fixture
def silhouette() -> Silhouette:
    """A wall 2 m away in the left half of the image, unknown pixels above on the right."""
    depth = np.zeros((66, 88))
    depth[:, :44] = 2.0
    depth[:20, 60:] = np.nan
    return Silhouette(CAMERA, depth)


def point(column: float, row: float, z: float) -> np.ndarray:
    return np.array([(column - CAMERA.cx) / CAMERA.fx * z, (row - CAMERA.cy) / CAMERA.fy * z, z])


@pytest.mark.parametrize("column", [-30.0, -2.0, 90.0, 300.0])
def test_nothing_beyond_the_picture_is_in_free_space(silhouette, column):
    points = point(column, 30.0, 1.5)[None]
    distances, gradients = silhouette.distances(points, np.zeros(1))
    assert not distances.any()
    assert not gradients.any()
    assert not silhouette.observable(points).any()


def test_free_space_is_observable(silhouette):
    points = np.stack([point(70.0, 50.0, 1.5), point(20.0, 50.0, 1.5)])
    assert (silhouette.distances(points, np.zeros(2))[0] > 0.0).all()
    assert silhouette.observable(points, 0.1).all()


def test_unknown_pixels_show_nothing(silhouette):
    points = np.stack([point(75.0, 8.0, z) for z in (0.5, 3.0)])
    assert not silhouette.observable(points).any()
    assert not silhouette.distances(points, np.zeros(2))[0].any()


def test_measured_surfaces_hide_what_is_farther_behind_them_than_the_margin(silhouette):
    points = np.stack([point(20.0, 30.0, z) for z in (1.9, 2.05, 2.2)])
    assert silhouette.observable(points, 0.1).tolist() == [True, True, False]
    assert silhouette.observable(points).all()


def test_nothing_behind_the_camera_is_observable(silhouette):
    assert not silhouette.observable(np.array([[0.0, 0.0, -1.0]])).any()


OBLONG = Camera(width=180, height=131, fx=190.0, fy=230.0, cx=83.2, cy=70.9)
SIDE = 2  # 180 columns are reduced to 90 blocks.


def patchy(random: np.random.Generator, share: float) -> np.ndarray:
    """An image with a ``share`` of depth in patches, and with unknown ones."""
    depth = np.zeros((OBLONG.height, OBLONG.width))
    for value in (np.nan, *random.uniform(1.0, 3.0, size=int(60 * share))):
        row, column = random.integers(OBLONG.height), random.integers(OBLONG.width)
        depth[row : row + random.integers(1, 18), column : column + random.integers(1, 18)] = value
    noise = random.uniform(0.9, 1.1, size=depth.shape)
    return depth * noise


def blocks_of(depth: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Returns the least depth of each block (rows, columns), and its centre (rows, columns, 2)."""
    rows, columns = depth.shape[0] // SIDE, depth.shape[1] // SIDE
    cells = depth[: rows * SIDE, : columns * SIDE].reshape(rows, SIDE, columns, SIDE)
    nearest = np.where(cells > 0.0, cells, np.inf).min(axis=(1, 3))
    unknown = np.isnan(cells).any(axis=(1, 3)) & np.isinf(nearest)
    pixels = np.stack(np.meshgrid(np.arange(columns), np.arange(rows)), axis=2) * SIDE + 0.5
    centres = (pixels - [OBLONG.cx, OBLONG.cy]) / [OBLONG.fx, OBLONG.fy]
    return np.where(unknown, 0.0, nearest), centres


def spread(random: np.random.Generator, count: int) -> tuple[np.ndarray, np.ndarray]:
    """Points in and around the view, and the row and column of their blocks."""
    pixels = random.uniform(-20.0, 200.0, size=(count, 2))
    z = random.uniform(0.5, 3.5, size=count)
    rays = (pixels - [OBLONG.cx, OBLONG.cy]) / [OBLONG.fx, OBLONG.fy]
    blocks = np.rint((pixels - 0.5) / SIDE).astype(int)
    return np.column_stack([rays * z[:, None], z]), blocks[:, ::-1]


@pytest.mark.parametrize("share", [0.0, 0.05, 0.3, 1.0])
def test_distance_is_that_to_the_nearest_of_all_blocks_with_depth(random, share):
    depth = patchy(random, share)
    nearest, centres = blocks_of(depth)
    points, blocks = spread(random, 400)
    margins = random.uniform(0.0, 0.2, size=len(points))
    found, gradients = Silhouette(OBLONG, depth).distances(points, margins)
    shown = centres[np.isfinite(nearest)]
    expected = np.zeros(len(points))
    for k, (point, (row, column)) in enumerate(zip(points, blocks, strict=True)):
        if not (0 <= row < nearest.shape[0] and 0 <= column < nearest.shape[1]):
            continue
        if np.isfinite(nearest[row, column]):
            expected[k] = max(nearest[row, column] - margins[k] - point[2], 0.0)
        elif len(shown):
            away = np.linalg.norm(shown - point[:2] / point[2], axis=1).min()
            expected[k] = max(point[2] * (away - 0.75 * SIDE / OBLONG.fx), 0.0)
    np.testing.assert_allclose(found, expected, atol=1e-12)
    assert not gradients[expected == 0.0].any()


def test_gradient_of_the_distance_is_its_derivative(random):
    silhouette = Silhouette(OBLONG, patchy(random, 0.3))
    points, _ = spread(random, 400)
    margins = np.full(len(points), 0.05)
    found, gradients = silhouette.distances(points, margins)
    checked = 0
    for k in np.flatnonzero(found):
        numeric = np.empty(3)
        for axis in range(3):
            step = np.zeros(3)
            step[axis] = 1e-6
            ends = silhouette.distances(np.stack([points[k] + step, points[k] - step]), margins[:2])
            numeric[axis] = (ends[0][0] - ends[0][1]) / 2e-6
        # A step may cross a border between two blocks, where the distance has a kink.
        if np.abs(numeric - gradients[k]).max() < 1e-6:
            checked += 1
    assert checked >= 0.98 * np.count_nonzero(found) > 50


def test_observable_points_are_in_the_picture_on_known_blocks_and_not_hidden(random):
    depth = patchy(random, 0.5)
    nearest, _ = blocks_of(depth)
    points, blocks = spread(random, 400)
    expected = np.zeros(len(points), dtype=bool)
    for k, (row, column) in enumerate(blocks):
        if 0 <= row < nearest.shape[0] and 0 <= column < nearest.shape[1]:
            least = nearest[row, column]
            expected[k] = least > 0.0 and points[k, 2] - 0.1 <= least
    silhouette = Silhouette(OBLONG, depth)
    assert 50 < expected.sum() < 350
    np.testing.assert_array_equal(silhouette.observable(points, 0.1), expected)
    each = np.full(len(points), 0.1)
    np.testing.assert_array_equal(silhouette.observable(points, each), expected)
    reversed_ = silhouette.observable(points[::-1], each[::-1])
    np.testing.assert_array_equal(reversed_[::-1], expected)


@pytest.mark.parametrize("dtype", [np.float64, np.float32])
def test_image_of_another_layout_shows_the_same(random, dtype):
    depth = patchy(random, 0.4).astype(dtype)
    points, _ = spread(random, 100)
    kept = Silhouette(OBLONG, depth.astype(np.float64)).distances(points, np.zeros(100))
    fixed = np.asfortranarray(depth)
    fixed.flags.writeable = False
    found = Silhouette(OBLONG, fixed).distances(points, np.zeros(100))
    np.testing.assert_array_equal(found[0], kept[0])
