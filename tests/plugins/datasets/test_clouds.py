"""Clouds in folders: what is read, and what is said of files that are wrong."""

import sys
from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest
from damage import complaint, cut, everything, remove, write
from messages import tells

from regkit_plugins.datasets.clouds import CloudFolders


def write_clouds(folder: Path, clouds: list[np.ndarray]) -> Path:
    (folder / "clouds").mkdir(parents=True)
    (folder / "sequence.yaml").write_text("fps: 10\n")
    for frame, points in enumerate(clouds):
        np.savez(folder / "clouds" / f"{frame:06d}.npz", points=points)
    return folder


def test_clouds_of_arrays_are_read_without_open3d(tmp_path, random, monkeypatch):
    clouds = [random.normal(size=(30 + frame, 3)) for frame in range(3)]
    folder = write_clouds(tmp_path / "one", clouds)
    monkeypatch.setitem(sys.modules, "open3d", None)
    (found,) = CloudFolders(root=folder).chosen()
    assert (found.name, found.fps, found.length) == ("one", 10.0, 3)
    for frame, points in zip(found.frames(), clouds, strict=True):
        np.testing.assert_array_equal(frame.points, points)
        assert frame.camera is None
    assert CloudFolders(root=folder, frames=2).chosen()[0].length == 2


@pytest.mark.parametrize("suffix", [".ply", ".pcd", ".xyz"])
def test_clouds_that_open3d_wrote_are_read(tmp_path, random, suffix):
    library = pytest.importorskip("open3d")
    points = random.normal(size=(50, 3))
    (tmp_path / "clouds").mkdir()
    (tmp_path / "sequence.yaml").write_text("fps: 10\n")
    cloud = library.geometry.PointCloud(library.utility.Vector3dVector(points))
    assert library.io.write_point_cloud(str(tmp_path / "clouds" / f"000000{suffix}"), cloud)
    (frame,) = everything(CloudFolders(root=tmp_path))
    np.testing.assert_allclose(frame.points, points, atol=1e-6)


def test_points_that_are_not_finite_are_missing_measurements(tmp_path):
    points = np.ones((40, 3))
    points[7, 2], points[9, 0] = np.nan, -np.inf
    folder = write_clouds(tmp_path / "one", [points, np.full((4, 3), np.nan)])
    frames = everything(CloudFolders(root=folder))
    assert [len(frame.points) for frame in frames] == [38, 0]


def npz(**arrays) -> Callable[[Path], None]:
    return lambda folder: np.savez(folder / CLOUD, **arrays)


def bare_array(folder: Path) -> None:
    with (folder / CLOUD).open("wb") as stream:
        np.save(stream, np.ones((30, 3)))


CLOUD = "clouds/000001.npz"
NO_ARRAY = f"ROOT/{CLOUD}: not a .npz with an array 'points' (N, 3)"


@pytest.mark.parametrize(
    ("damage", "expected"),
    [
        (npz(pts=np.ones((30, 3))), NO_ARRAY),
        (npz(points=np.array([["a", "b", "c"]])), NO_ARRAY),
        (npz(points=np.array([[1.0, 2.0, None]])), f"ROOT/{CLOUD}: array 'points' holds Python"),
        (npz(points=np.ones((30, 2))), NO_ARRAY),
        (npz(points=np.ones((0, 3))), f"ROOT/{CLOUD}: the file contains no points"),
        (write(CLOUD, b""), NO_ARRAY),
        (write(CLOUD, "hello"), NO_ARRAY),
        (cut(CLOUD, 0.5), NO_ARRAY),
        (bare_array, NO_ARRAY),
        (remove("clouds"), "ROOT: no recording here: neither this folder nor one in it contains "
         "'clouds/'"),
        (remove("clouds", "000000.npz"), "ROOT/clouds: files must be numbered from 000000"),
    ],
)  # fmt: skip
def test_cloud_that_is_wrong_is_told_with_its_place(tmp_path, random, damage, expected):
    folder = write_clouds(tmp_path / "one", [random.normal(size=(50, 3)) for _ in range(2)])
    dataset = CloudFolders(root=folder)
    assert len(everything(dataset)) == 2
    damage(folder)
    assert complaint(dataset, folder).startswith(expected)


@pytest.mark.parametrize("kept", [0.0, 0.1, 0.6])
@pytest.mark.parametrize("suffix", [".ply", ".pcd"])
def test_cloud_file_cut_short_is_refused(tmp_path, random, suffix, kept):
    """Rather than read what happens to be in the memory where the missing points would be."""
    library = pytest.importorskip("open3d")
    (tmp_path / "clouds").mkdir()
    (tmp_path / "sequence.yaml").write_text("fps: 10\n")
    name = f"clouds/000000{suffix}"
    cloud = library.geometry.PointCloud(library.utility.Vector3dVector(random.random((500, 3))))
    library.io.write_point_cloud(str(tmp_path / name), cloud)
    cut(name, kept)(tmp_path)
    message = complaint(CloudFolders(root=tmp_path), tmp_path)
    assert tells(message, at=f"ROOT/{name}", of=())
