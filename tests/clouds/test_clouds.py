"""Clouds by themselves: files, voxels, neighbourhoods, and what cannot be aligned."""

import numpy as np
import pytest

from regkit.clouds import (
    check_writable,
    normals,
    read_cloud,
    spacing,
    voxel_downsampled,
    write_cloud,
)
from regkit.clouds.checks import check_shape, check_sizes
from regkit.clouds.voxels import voxel_for
from regkit.geometry.rotation import vector_to_matrix
from regkit.system.errors import ConfigError, DataError
from regkit.system.threads import using_threads


@pytest.mark.parametrize("suffix", [".npz", ".txt", ".csv", ".xyz", ".ply", ".pcd"])
def test_cloud_that_is_written_is_read_again(tmp_path, random, suffix):
    if suffix in (".ply", ".pcd"):
        pytest.importorskip("open3d")
    points = random.normal(size=(30, 3))
    path = tmp_path / f"cloud{suffix}"
    write_cloud(path, points)
    np.testing.assert_allclose(read_cloud(path), points, atol=1e-6)
    assert [file.name for file in tmp_path.iterdir()] == [path.name]


@pytest.mark.parametrize(
    ("name", "text", "expected"),
    [
        ("a.txt", "", "a.txt:1: the file contains no points"),
        ("a.txt", "1 2 3\n4 5\n", "a.txt:2: 2 cells"),
        ("a.npz", "words", "a.npz: not a .npz with an array 'points' (N, 3)"),
        ("a.doc", "1 2 3", "a.doc: files that end with '.doc' cannot be read; convert it to one"),
        ("a.ply", "words", "a.ply: not a PLY file"),
        ("a.stl", "words", "a.stl: announces 0 triangles"),
        ("a.glb", "words", "a.glb: not a glTF 2.0 file"),
    ],
)
def test_file_that_is_wrong_is_told(tmp_path, name, text, expected):
    (tmp_path / name).write_text(text)
    with pytest.raises(DataError) as caught:
        read_cloud(tmp_path / name)
    assert str(caught.value).removeprefix(f"{tmp_path}/").startswith(expected)


def test_missing_file_and_folder_are_told(tmp_path):
    with pytest.raises(DataError, match="there is no such file"):
        read_cloud(tmp_path / "a.ply")
    with pytest.raises(DataError, match="this is a folder, not a file"):
        read_cloud(tmp_path)


@pytest.mark.parametrize("suffix", [".ply", ".obj", ".stl", ".off"])
def test_points_of_a_mesh_lie_on_it(tmp_path, suffix):
    library = pytest.importorskip("open3d")
    box = library.geometry.TriangleMesh.create_box(1.0, 2.0, 3.0)
    box.compute_triangle_normals()
    path = tmp_path / f"box{suffix}"
    library.io.write_triangle_mesh(str(path), box)
    points = read_cloud(path)
    faces = np.minimum(np.abs(points), np.abs(points - [1.0, 2.0, 3.0])).min(axis=1)
    assert faces.max() < 1e-6
    # A side's share of the points is its share of the area: 2 (2 + 3 + 6) in all.
    assert np.mean(np.abs(points[:, 2] - 3.0) < 1e-6) == pytest.approx(2.0 / 22.0, abs=0.01)
    np.testing.assert_array_equal(points, read_cloud(path))


def test_unknown_suffix_is_refused_before_writing(tmp_path):
    with pytest.raises(ConfigError, match=r"--out x: the name must end with one of \.ply"):
        check_writable(tmp_path / "a.doc", place="--out x")


def test_thinned_cloud_has_the_mean_of_each_cube(random):
    points = random.uniform(-3.0, 3.0, size=(500, 3))
    thin = voxel_downsampled(points, 1.0)
    assert len(np.unique(np.floor(thin), axis=0)) == len(thin) == 216 - _empty(points)
    cube = np.floor(points) == np.floor(thin[0])
    np.testing.assert_allclose(points[cube.all(axis=1)].mean(axis=0), thin[0])


def _empty(points):
    return 216 - len(np.unique(np.floor(points), axis=0))


def test_voxel_for_a_number_of_points_leaves_about_so_many(lump):
    assert voxel_for(lump, len(lump)) is None
    left = len(voxel_downsampled(lump, voxel_for(lump, 300)))
    assert 270 <= left <= 300


def test_spacing_of_a_grid_is_its_step():
    grid = 0.1 * np.stack(np.meshgrid(np.arange(20), np.arange(20), [0]), axis=-1).reshape(-1, 3)
    assert spacing(grid) == pytest.approx(0.1)


def test_normals_of_a_sphere_are_its_radii_and_turn_with_it(random):
    points = random.normal(size=(4000, 3))
    points /= np.linalg.norm(points, axis=1, keepdims=True)
    directions = normals(points)
    np.testing.assert_allclose(np.linalg.norm(directions, axis=1), 1.0)
    assert np.abs((directions * points).sum(axis=1)).min() > 0.99
    rotation = vector_to_matrix(np.array([0.3, -1.0, 0.5]))
    turned = normals(points @ rotation.T)
    agreement = np.abs((turned * (directions @ rotation.T)).sum(axis=1))
    np.testing.assert_allclose(agreement, 1.0, atol=1e-6)


def test_normals_of_a_plane_are_exact(random):
    points = random.normal(size=(100, 3)) * [1.0, 1.0, 0.0]
    np.testing.assert_allclose(np.abs(normals(points)[:, 2]), 1.0)


@pytest.mark.parametrize(
    ("points", "expected"),
    [
        (np.eye(3)[:2], "a: the cloud has 2 different points of 2; at least 10 are needed"),
        (np.ones((50, 3)), "a: the cloud has 1 different points of 50; at least 10"),
        (np.outer(np.arange(20.0), [1, 2, 3]), "a: all points lie on a line"),
        (np.random.default_rng(0).normal(size=(50, 3)) * [1, 1, 0], "a: all points lie in a plane"),
    ],
)
def test_cloud_whose_pose_is_not_determined_is_refused(points, expected):
    with pytest.raises(DataError) as caught:
        check_shape(points, place="a")
    assert str(caught.value).startswith(expected)


def test_clouds_of_different_units_are_refused(lump):
    check_shape(lump, place="a")
    check_sizes(lump, 3.0 * lump)
    with pytest.raises(DataError, match=r"a factor of 1e\+03.*one in millimetres"):
        check_sizes(lump, 1000.0 * lump)


def test_voxel_is_the_same_however_its_search_is_divided(random, monkeypatch):
    points = random.normal(size=(20_000, 3))
    whole = voxel_for(points, 100)
    monkeypatch.setattr("regkit.clouds.voxels.POINTS", 500)
    with using_threads(2):
        assert voxel_for(points, 100) == whole
    assert 90 < len(voxel_downsampled(points, whole)) <= 100


def test_flat_cloud_is_refused_however_its_points_are_divided(lump, monkeypatch):
    monkeypatch.setattr("regkit.clouds.checks.POINTS", 20)
    far = lump + np.array([4.1e6, -2.7e6, 0.0])
    check_shape(far, place="a")
    with pytest.raises(DataError, match="in a plane"):
        check_shape(far * [1.0, 1.0, 0.0], place="a")
