"""Organised clouds are read as the depth images that they are; all others stay clouds."""

import warnings

import numpy as np
import pytest
from places import CASES

import regkit
from regkit.clouds import read_cloud
from regkit.geometry.rigid import rigid, transformed
from regkit.geometry.rotation import from_vector, to_matrix
from regkit.observation.organised import organised_frame
from regkit.testing.samples import CAMERA
from regkit_plugins.datasets.clouds import CloudFolders

TURN = from_vector(np.array([0.3, -0.5, 0.2]))
PLACE = np.array([0.4, -1.0, 2.0])


@pytest.fixture
def depth(random):
    image = 1.0 + random.uniform(size=(CAMERA.height, CAMERA.width))
    image[random.uniform(size=image.shape) < 0.3] = 0.0
    return image


def grid(depth):
    """Returns the points (H, W, 3) of a depth image; NaN where it has none."""
    points = CAMERA.rays() * depth[..., None]
    points[depth == 0.0] = np.nan
    return points


def write_pcd(path, points, viewpoint=(0, 0, 0, 1, 0, 0, 0)):
    height, width = points.shape[:2]
    head = (
        "VERSION 0.7\nFIELDS x y z\nSIZE 4 4 4\nTYPE F F F\nCOUNT 1 1 1\n"
        f"WIDTH {width}\nHEIGHT {height}\nVIEWPOINT {' '.join(map(str, viewpoint))}\n"
        f"POINTS {width * height}\nDATA binary\n"
    )
    path.write_bytes(head.encode() + points.astype("<f4").tobytes())
    return path


def write_ply(path, points):
    height, width = points.shape[:2]
    head = (
        f"ply\nformat binary_little_endian 1.0\nelement vertex {width * height}\n"
        "property float x\nproperty float y\nproperty float z\nelement camera 1\n"
        "property float focal\nproperty int viewportx\nproperty int viewporty\nend_header\n"
    )
    camera = np.float32(0).tobytes() + np.array([width, height], "<i4").tobytes()
    path.write_bytes(head.encode() + points.astype("<f4").tobytes() + camera)
    return path


def assert_is(frame, depth):
    seen = frame.camera
    np.testing.assert_allclose(
        [seen.fx, seen.fy, seen.cx, seen.cy],
        [CAMERA.fx, CAMERA.fy, CAMERA.cx, CAMERA.cy],
        atol=1e-2,
    )
    np.testing.assert_allclose(frame.depth, depth, atol=1e-5)
    np.testing.assert_allclose(frame.points, CAMERA.back_projected(depth), atol=1e-5)
    assert len(frame.pixels) == len(frame.points)


@pytest.mark.parametrize("write", [write_pcd, write_ply])
def test_organised_cloud_is_the_depth_image_of_its_camera(tmp_path, depth, write):
    path = write(tmp_path / f"a.{write.__name__[-3:]}", grid(depth))
    with pytest.warns(regkit.RegkitWarning, match=r"f = 230 px and c = \(87.5, 71.5\)") as told:
        assert_is(regkit.load_frame(path), depth)
    assert len(told) == 1


def test_missing_points_may_be_zero_and_a_few_points_elsewhere(tmp_path, depth, random):
    points = np.nan_to_num(grid(depth))
    stray = tuple(random.integers(0, CAMERA.height, size=(2, 100)))
    points[stray] += np.array([0.3, -0.2, 0.0]) * (depth[stray] > 0.0)[:, None]
    frame = organised_frame(write_pcd(tmp_path / "a.pcd", points), tell=False)
    assert frame.camera.fx == pytest.approx(CAMERA.fx, abs=1e-2)
    np.testing.assert_allclose(frame.depth, depth, atol=1e-5)


def test_viewpoint_counts_where_the_points_are_not_in_the_cameras_frame(tmp_path, depth):
    moved = transformed(rigid(to_matrix(TURN), PLACE), grid(depth).reshape(-1, 3))
    path = write_pcd(
        tmp_path / "a.pcd", moved.reshape(*depth.shape, 3), (*PLACE, *(2.0 * TURN[[3, 0, 1, 2]]))
    )
    with pytest.warns(regkit.RegkitWarning, match="in the frame of its VIEWPOINT"):
        assert_is(regkit.load_frame(path), depth)
    # PCL's recorders give a viewpoint to points that are in the camera's frame.
    path = write_pcd(tmp_path / "b.pcd", grid(depth), (0, 0, 0, 0, 1, 0, 0))
    assert_is(organised_frame(path, tell=False), depth)
    path = write_pcd(tmp_path / "c.pcd", grid(depth), (0, 0, 0, 0, 0, 0, 0))
    with pytest.raises(regkit.RegkitError, match="VIEWPOINT is '0 0 0 0 0 0 0'"):
        regkit.load_frame(path)


def test_grid_of_no_pinhole_camera_stays_a_cloud(tmp_path, random):
    rows, columns = np.mgrid[:60, :80]
    heights = 1.0 + 0.3 * random.uniform(size=rows.shape)
    orthographic = np.stack([0.01 * columns, 0.01 * rows, heights], axis=2)
    mirrored = CAMERA.rays()[:60, :80] * [-1.0, 1.0, 1.0]
    for points in (orthographic, mirrored, -mirrored, np.ones((2, 3, 3))):
        path = write_pcd(tmp_path / "a.pcd", points)
        frame = regkit.load_frame(path)
        assert frame.camera is None
        np.testing.assert_array_equal(frame.points, read_cloud(path))
    with pytest.warns(regkit.RegkitWarning, match="5948 of 7000 points are missing"):
        assert regkit.load_frame(CASES / "04-pcd-nan/nan_binary.pcd").camera is None


def test_alignment_takes_all_points_of_an_organised_cloud(tmp_path, depth):
    path = write_pcd(tmp_path / "a.pcd", grid(depth))
    with pytest.warns(regkit.RegkitWarning, match="are missing measurements"):
        assert len(read_cloud(path)) == np.count_nonzero(depth)


def test_folder_of_organised_clouds_is_a_recording_of_depth_images(tmp_path, depth):
    (tmp_path / "clouds").mkdir()
    (tmp_path / "sequence.yaml").write_text("fps: 10\n")
    nothing = np.full((*depth.shape, 3), np.nan)
    for index, points in enumerate((grid(depth), grid(depth[::-1]), nothing)):
        write_pcd(tmp_path / "clouds" / f"{index:06d}.pcd", points)
    (found,) = CloudFolders(root=tmp_path).chosen()
    with pytest.warns(regkit.RegkitWarning, match="000000.pcd: read as the depth image"):
        frames = list(found.frames())
    assert_is(frames[0], depth)
    assert_is(frames[1], depth[::-1])
    assert len(frames[2].points) == 0
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        list(found.some([1]))
