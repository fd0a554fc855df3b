"""Cameras: intrinsics by rows or columns, and what no camera has."""

import json
from pathlib import Path

import numpy as np
import pytest

from regkit.geometry.camera import Camera
from regkit.geometry.intrinsics import intrinsics_of
from regkit.system.errors import DataError
from regkit.system.notes import RegkitWarning

CASES = Path(__file__).parents[1] / "cases" / "11-intrinsics"
K = np.array([[231.0, 0.0, 87.5], [0.0, 230.0, 71.5], [0.0, 0.0, 1.0]])
NUMBERS = (231.0, 230.0, 87.5, 71.5)


def other(row, column, value):
    matrix = K.copy()
    matrix[row, column] = value
    return matrix


@pytest.mark.parametrize("name", ["walk_rows_3x3", "walk_half_scale"])
def test_cameras_of_other_programs_are_the_same(name):
    assert Camera.read(CASES / name / "camera.json") == Camera(176, 144, 231, 231, 87.5, 71.5)


def test_matrix_by_rows_is_read_by_rows():
    camera = Camera.read(CASES / "by_rows_flat" / "camera.json")
    assert camera == Camera(64, 48, 60, 60, 33.5, 22.5)


@pytest.mark.parametrize(
    "matrix",
    [K, K.T, K.ravel(), K.T.ravel(), K.tolist(), K.T.ravel().tolist()],
)
def test_matrix_is_read_by_rows_and_by_columns(matrix):
    assert intrinsics_of(matrix) == NUMBERS


@pytest.mark.parametrize(
    ("matrix", "word"),
    [
        (2.0 * K, "0 0 1"),
        (other(2, 1, 1e-3), "0 0 1"),
        (other(0, 1, 1.0), "skew"),
        (other(1, 0, 1.0), "skew"),
        (K[:2], "9 numbers"),
        (K[:, :, None], "9 numbers"),
        (np.eye(4), "9 numbers"),
        (K.astype(complex), "complex"),
        ([["a"] * 3] * 3, "9 numbers"),
    ],
)
def test_matrix_that_is_no_camera_is_refused(matrix, word):
    with pytest.raises(DataError) as caught:
        intrinsics_of(matrix)
    assert word in caught.value.message


@pytest.mark.parametrize(
    "changed",
    [
        {"width": 0}, {"height": -1}, {"width": 176.0}, {"width": True}, {"width": 10**6},
        {"width": "176"}, {"fx": 0.0}, {"fy": -230.0}, {"fx": np.nan}, {"fy": np.inf}, {"fx": 0.9},
        {"fx": 1e9}, {"cx": np.nan}, {"cy": np.inf}, {"cx": -177.0}, {"cy": 300.0},
        {"cx": 0.0, "cy": 0.0},
    ],
)  # fmt: skip
def test_camera_that_cannot_be_is_refused(changed):
    numbers = {
        "width": 176,
        "height": 144,
        **dict(zip(("fx", "fy", "cx", "cy"), NUMBERS, strict=True)),
    }
    Camera(**numbers)
    with pytest.raises(DataError) as caught:
        Camera(**{**numbers, **changed})
    assert any(name in caught.value.message for name in ("width", "height", "f", "c"))


def test_pixels_with_depth_are_back_projected_in_row_major_order(random):
    camera = Camera(40, 30, 41.0, 47.0, 18.7, 16.1)
    depth = np.where(random.uniform(size=(30, 40)) < 0.4, random.uniform(1.0, 4.0, (30, 40)), 0.0)
    depth[3:5, 7:20] = np.nan
    rows, columns = np.nonzero(depth > 0.0)
    z = depth[rows, columns]
    points = camera.back_projected(depth)
    expected = np.column_stack([(columns - 18.7) / 41.0 * z, (rows - 16.1) / 47.0 * z, z])
    np.testing.assert_allclose(points, expected, rtol=1e-14)
    pixels = np.column_stack([columns, rows])
    np.testing.assert_allclose(camera.projected(points), pixels, atol=1e-12)
    read_only = np.asfortranarray(depth)
    read_only.flags.writeable = False
    np.testing.assert_array_equal(camera.back_projected(read_only), points)
    assert camera.back_projected(np.zeros((30, 40))).shape == (0, 3)
    depth[0, 0] = np.inf
    with pytest.raises(DataError, match="unit"):
        camera.back_projected(depth)


def content(**changed):
    numbers = {"width": 176, "height": 144, "intrinsic_matrix": K.T.ravel().tolist()}
    return json.dumps(numbers | changed)


@pytest.mark.parametrize(
    ("text", "word"),
    [
        (content(width="176"), "'176'"),
        (content(width=176.5), "176.5"),
        (content(width=None), "None"),
        (content(intrinsic_matrix=[True] * 9), "9 numbers"),
        (content(intrinsic_matrix=["1"] * 9), "9 numbers"),
        (content(intrinsic_matrix=[[1], [2, 3]]), "camera"),
        (content(intrinsic_matrix={}), "9 numbers"),
        (content().replace("231.0", "1e400"), "1e400"),
        (content().replace("231.0", "NaN"), "NaN"),
        (content().replace("231.0", "-Infinity"), "-Infinity"),
        (content().replace("176", "1e400"), "1e400"),
        (content().replace("176", "9" * 5000), "camera"),
        (content().replace('"height": 144', '"width": 144'), "twice"),
        (content().replace("144,", "144"), "camera.json:1"),
        ("[" * 100_000, "camera"),
        ("null", "object"),
        ("", "not JSON"),
    ],
)
def test_camera_file_that_is_wrong_is_refused(tmp_path, text, word):
    path = tmp_path / "camera.json"
    path.write_text(text)
    with pytest.raises(DataError, match=r"camera\.json") as caught:
        Camera.read(path)
    assert word in str(caught.value)


def test_distortion_of_a_camera_file_is_told(tmp_path):
    path = tmp_path / "camera.json"
    path.write_text(content(distortion=[0.1, 0.2]))
    with pytest.warns(RegkitWarning, match="distortion"):
        assert Camera.read(path).fx == 231.0
