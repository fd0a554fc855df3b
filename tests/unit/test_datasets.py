"""Datasets: what they read, and what they say of files that are wrong."""

import shutil
import sys
from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest
from PIL import Image
from scipy.io import savemat
from scipy.spatial import KDTree

from regkit.geometry.camera import Camera
from regkit.interfaces import Dataset
from regkit.observation import Frame
from regkit.system.errors import ConfigError, DataError, RegkitError
from regkit_plugins.datasets.clouds import CloudFolders
from regkit_plugins.datasets.depth import DepthFolders
from regkit_plugins.datasets.utd_mhad import CAMERA, JOINTS, UtdMhad

SMALL = Camera(width=24, height=18, fx=20.0, fy=22.0, cx=11.5, cy=8.5)
FRAMES = 3


def plane(frame: int = 0) -> np.ndarray:
    """Depth [m] of the plane z = 2 + 0.3 x + 0.2 y, farther away in every frame."""
    rays = SMALL.rays()
    return (2.0 + 0.1 * frame) / (1.0 - 0.3 * rays[..., 0] - 0.2 * rays[..., 1])


def write_image(path: Path, depth: np.ndarray, scale: float = 10_000.0) -> None:
    path.parent.mkdir(parents=True, exist_ok=True)
    Image.fromarray(np.rint(scale * depth).astype(np.uint16)).save(path)


def write_recording(folder: Path, header: str = "fps: 15\ndepth_scale: 10000\n") -> Path:
    for frame in range(FRAMES):
        write_image(folder / "depth" / f"{frame:06d}.png", plane(frame))
    (folder / "camera.json").write_text(SMALL.to_json())
    (folder / "sequence.yaml").write_text(header)
    return folder


def write_clouds(folder: Path, clouds: list[np.ndarray]) -> Path:
    (folder / "clouds").mkdir(parents=True)
    (folder / "sequence.yaml").write_text("fps: 10\n")
    for frame, points in enumerate(clouds):
        np.savez(folder / "clouds" / f"{frame:06d}.npz", points=points)
    return folder


def everything(dataset: Dataset) -> list[Frame]:
    """All that a run reads."""
    recordings = dataset.chosen()
    for recording in recordings:
        recording.truth()
    return [frame for recording in recordings for frame in recording.frames()]


def complaint(dataset: Dataset, root: Path) -> str:
    with pytest.raises(RegkitError) as caught:
        everything(dataset)
    return str(caught.value).replace(str(root), "ROOT")


@pytest.fixture
def recording(tmp_path) -> Path:
    return write_recording(tmp_path / "one")


# Depth images in folders.


def test_depth_of_a_plane_is_back_projected_onto_the_plane(recording):
    (found,) = DepthFolders(root=recording).chosen()
    assert (found.name, found.fps, found.length) == ("one", 15.0, FRAMES)
    frames = list(found.frames())
    assert len(frames) == FRAMES
    for index, frame in enumerate(frames):
        x, y, z = frame.points.T
        assert len(frame.points) == SMALL.width * SMALL.height
        np.testing.assert_allclose(z, 2.0 + 0.1 * index + 0.3 * x + 0.2 * y, atol=1e-4)
        assert frame.camera == SMALL
        np.testing.assert_allclose(frame.depth, plane(index), atol=1e-4)
        assert frame.place == str(recording / "depth" / f"{index:06d}.png")


def test_depth_points_are_seen_at_their_pixels(recording):
    """Projection undoes back-projection, so x points right and y down."""
    (found,) = DepthFolders(root=recording).chosen()
    points = next(found.frames()).points
    rows, columns = np.mgrid[: SMALL.height, : SMALL.width]
    pixels = np.column_stack([columns.ravel(), rows.ravel()])
    np.testing.assert_allclose(SMALL.projected(points), pixels, atol=1e-9)


def test_depth_pixels_without_measurement_give_no_point(recording):
    depth = plane()
    depth[:5] = 0.0
    write_image(recording / "depth" / "000000.png", depth)
    (found,) = DepthFolders(root=recording).chosen()
    points = next(found.frames()).points
    assert len(points) == SMALL.width * (SMALL.height - 5)
    assert (points[:, 2] > 0.0).all()


@pytest.mark.parametrize(("scale", "factor"), [("10000", 1.0), ("5000", 2.0), ("1000", 10.0)])
def test_depth_scale_is_the_units_per_metre(tmp_path, scale, factor):
    folder = write_recording(tmp_path / "one", f"depth_scale: {scale}\n")
    frame = everything(DepthFolders(root=folder))[0]
    np.testing.assert_allclose(frame.depth, factor * plane(), atol=1e-3)


def test_depth_scale_is_one_millimetre_where_it_is_not_given(tmp_path):
    folder = write_recording(tmp_path / "one", "fps: 15\n")
    frame = everything(DepthFolders(root=folder))[0]
    np.testing.assert_allclose(frame.depth, 10.0 * plane(), atol=1e-3)


@pytest.mark.parametrize("limit", [1, 2, 3, 100])
def test_depth_frames_are_limited(recording, limit):
    (recording / "truth.csv").write_text(
        "frame,joint,x,y,z\n" + "".join(f"{frame},a,0,0,{frame}\n" for frame in range(FRAMES))
    )
    (found,) = DepthFolders(root=recording, frames=limit).chosen()
    count = min(limit, FRAMES)
    assert found.length == len(list(found.frames())) == count
    np.testing.assert_array_equal(found.truth().positions[:, 0, 2], np.arange(count))


def test_truth_is_nan_where_a_joint_was_not_seen(recording):
    assert DepthFolders(root=recording).chosen()[0].truth() is None
    (recording / "truth.csv").write_text(
        "frame,joint,x,y,z\n0,head,1,2,3\n0,hand,4,5,6\n2,hand,-7,8e-1,9\n"
    )
    truth = DepthFolders(root=recording).chosen()[0].truth()
    assert truth.joints == ("head", "hand")
    nothing = [np.nan] * 3
    np.testing.assert_array_equal(
        truth.positions, [[[1, 2, 3], [4, 5, 6]], [nothing, nothing], [nothing, [-7, 0.8, 9]]]
    )


def test_truth_of_a_spreadsheet_is_read(recording):
    """With a byte-order mark and carriage returns."""
    (recording / "truth.csv").write_bytes(b"\xef\xbb\xbfframe,joint,x,y,z\r\n1,head,1,2,3\r\n")
    truth = DepthFolders(root=recording).chosen()[0].truth()
    assert truth.joints == ("head",)
    np.testing.assert_array_equal(truth.positions[1], [[1, 2, 3]])


def test_folder_of_folders_holds_their_recordings(tmp_path):
    for name in ("walk", "jump", "sit"):
        write_recording(tmp_path / "many" / name)
    write_recording(tmp_path / "many" / "other", "name: renamed\n")
    (tmp_path / "many" / "notes.txt").write_text("not a recording")
    (tmp_path / "many" / "empty").mkdir()
    root = tmp_path / "many"
    names = [found.name for found in DepthFolders(root=root).chosen()]
    assert names == ["jump", "renamed", "sit", "walk"]
    chosen = DepthFolders(root=root, recordings=("walk", "renamed")).chosen()
    assert [found.name for found in chosen] == ["walk", "renamed"]
    assert all(len(list(found.frames())) == FRAMES for found in chosen)
    with pytest.raises(ConfigError) as caught:
        DepthFolders(root=root, recordings=("wlak",)).chosen()
    assert str(caught.value) == (
        "dataset.recordings: no recording 'wlak' (there are: jump, renamed, sit, walk); did "
        "you mean 'walk'?"
    )


def test_recordings_of_the_same_name_are_refused(tmp_path):
    for folder in ("a", "b"):
        write_recording(tmp_path / folder, "name: same\n")
    message = complaint(DepthFolders(root=tmp_path), tmp_path)
    assert message == "dataset: two recordings are called 'same'"


def remove(*parts: str) -> Callable[[Path], None]:
    def act(folder: Path) -> None:
        path = folder.joinpath(*parts)
        shutil.rmtree(path) if path.is_dir() else path.unlink()

    return act


def cut(name: str, kept: float) -> Callable[[Path], None]:
    def act(folder: Path) -> None:
        content = (folder / name).read_bytes()
        (folder / name).write_bytes(content[: int(kept * len(content))])

    return act


def write(name: str, text: str | bytes) -> Callable[[Path], None]:
    def act(folder: Path) -> None:
        (folder / name).write_bytes(text.encode() if isinstance(text, str) else text)

    return act


def image(name: str, pixels: np.ndarray) -> Callable[[Path], None]:
    return lambda folder: Image.fromarray(pixels).save(folder / name)


HEADER = "frame,joint,x,y,z\n"
SECOND = "depth/000001.png"


@pytest.mark.parametrize(
    ("damage", "expected"),
    [
        (remove(), "ROOT: there is no such folder"),
        (remove("depth"), "ROOT: no recording here: neither the folder nor one in it has a folder "
         "'depth/' beside a sequence.yaml"),
        (remove("sequence.yaml"), "ROOT/sequence.yaml: there is no such file"),
        (remove(SECOND), "ROOT/depth: files must be numbered from 000000 without gaps; 000001 is "
         "missing before 000002.png"),
        (remove("depth", "000000.png"), "ROOT/depth: files must be numbered from 000000 without "
         "gaps; 000000 is missing before 000001.png"),
        (lambda folder: [path.unlink() for path in (folder / "depth").iterdir()],
         "ROOT/depth: the folder holds no .png file"),
        (cut(SECOND, 0.6), "ROOT/depth/000001.png: the image is damaged or cut short: "),
        (cut(SECOND, 0.0), "ROOT/depth/000001.png: the image is damaged or cut short: "),
        (write(SECOND, "hello"), "ROOT/depth/000001.png: the image is damaged or cut short: "),
        (image(SECOND, np.ones((18, 24), np.uint8)), "ROOT/depth/000001.png: a depth image has one "
         "channel of 16 bits; this one is of the mode L"),
        (image(SECOND, np.ones((18, 24, 3), np.uint8)), "ROOT/depth/000001.png: a depth image has "
         "one channel of 16 bits; this one is of the mode RGB"),
        (image(SECOND, np.ones((24, 18), np.uint16)), "ROOT/depth/000001.png: the depth image has "
         "18x24 pixels, but the camera has 24x18"),
        (remove("camera.json"), "ROOT/camera.json: the file is missing"),
        (cut("camera.json", 0.5), "ROOT/camera.json: not a camera file (JSONDecodeError"),
        (write("camera.json", b"\xff\xfe"), "ROOT/camera.json: not a camera file (UnicodeDecode"),
        (write("camera.json", "[1, 2]"), "ROOT/camera.json: not a camera file (TypeError"),
        (write("camera.json", '{"width": 24, "height": 18}'), "ROOT/camera.json: not a camera file "
         "(KeyError: 'intrinsic_matrix'); it must have width, height and intrinsic_matrix"),
        (write("camera.json", '{"width": 24, "height": 18, "intrinsic_matrix": [1, 2]}'),
         "ROOT/camera.json: not a camera file (ValueError"),
        (write("camera.json", SMALL.to_json().replace("20.0", "-20.0")),
         "ROOT/camera.json: width, height and both focal lengths must be positive"),
        (write("sequence.yaml", "name: x\nfpss: 15\n"), "ROOT/sequence.yaml:2: fpss: no such field "
         "(there are: depth_scale, fps, licence, name, source); did you mean 'fps'?"),
        (write("sequence.yaml", "fps: 0\n"), "ROOT/sequence.yaml:1: fps: input should be greater "
         "than 0; it is 0"),
        (write("sequence.yaml", "fps: 5\ndepth_scale: mm\n"), "ROOT/sequence.yaml:2: depth_scale: "
         "input should be a valid number"),
        (write("sequence.yaml", "name: ../../elsewhere\n"), "ROOT/sequence.yaml:1: name: string "
         "should match"),
        (write("truth.csv", "frame,joint,x,y\n"), "ROOT/truth.csv:1: the header must be "
         "frame,joint,x,y,z; it is frame,joint,x,y"),
        (write("truth.csv", ""), "ROOT/truth.csv:1: the header must be frame,joint,x,y,z; it is "),
        (write("truth.csv", b"\xff\xfe\x00"), "ROOT/truth.csv:1: the header must be"),
        (write("truth.csv", HEADER + "0,a,1,2,3\n0,b,1,2\n"), "ROOT/truth.csv:3: not a row of "
         "frame,joint,x,y,z: 0,b,1,2,None"),
        (write("truth.csv", HEADER + "0,a,1,2,3,4\n"), "ROOT/truth.csv:2: not a row of"),
        (write("truth.csv", HEADER + "0,a,1,2,far\n"), "ROOT/truth.csv:2: not a row of "
         "frame,joint,x,y,z: 0,a,1,2,far"),
        (write("truth.csv", HEADER + "-1,a,1,2,3\n"), "ROOT/truth.csv:2: not a row of "
         "frame,joint,x,y,z: -1,a,1,2,3"),
        (write("truth.csv", HEADER + "0,a,1,nan,3\n"), "ROOT/truth.csv:2: a position is NaN or "
         "infinite; leave the row out where a joint was not seen"),
        (write("truth.csv", HEADER + "0,a,1,2,inf\n"), "ROOT/truth.csv:2: a position is NaN"),
    ],
)  # fmt: skip
def test_depth_that_is_wrong_is_told_with_its_place(recording, damage, expected):
    dataset = DepthFolders(root=recording)
    assert len(everything(dataset)) == FRAMES
    damage(recording)
    assert complaint(dataset, recording).startswith(expected)


def test_damaged_frame_does_not_harm_those_before_it(recording):
    cut(SECOND, 0.5)(recording)
    frames = DepthFolders(root=recording).chosen()[0].frames()
    assert len(next(frames).points)
    with pytest.raises(DataError):
        next(frames)


# Point clouds in folders.


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
def test_clouds_of_other_formats_are_read_by_open3d(tmp_path, random, suffix):
    library = pytest.importorskip("open3d")
    points = random.normal(size=(50, 3))
    (tmp_path / "clouds").mkdir()
    (tmp_path / "sequence.yaml").write_text("fps: 10\n")
    cloud = library.geometry.PointCloud(library.utility.Vector3dVector(points))
    assert library.io.write_point_cloud(str(tmp_path / "clouds" / f"000000{suffix}"), cloud)
    (frame,) = everything(CloudFolders(root=tmp_path))
    np.testing.assert_allclose(frame.points, points, atol=1e-6)


@pytest.mark.parametrize("value", [np.nan, np.inf])
def test_cloud_with_a_point_that_is_not_finite_is_refused(tmp_path, value):
    points = np.ones((40, 3))
    points[7, 2] = value
    folder = write_clouds(tmp_path / "one", [np.ones((40, 3)), points])
    assert complaint(CloudFolders(root=folder), folder).startswith(
        "ROOT/clouds/000001.npz: 1 of 40 points have a NaN or infinite coordinate, first at point 7"
    )


def npz(**arrays) -> Callable[[Path], None]:
    return lambda folder: np.savez(folder / CLOUD, **arrays)


def bare_array(folder: Path) -> None:
    with (folder / CLOUD).open("wb") as stream:
        np.save(stream, np.ones((30, 3)))


CLOUD = "clouds/000001.npz"
NO_ARRAY = f"ROOT/{CLOUD}: not a .npz with an array 'points' (N, 3): "


@pytest.mark.parametrize(
    ("damage", "expected"),
    [
        (npz(pts=np.ones((30, 3))), NO_ARRAY),
        (npz(points=np.array([["a", "b", "c"]])), NO_ARRAY),
        (npz(points=np.array([[1.0, 2.0, None]])), NO_ARRAY),
        (npz(points=np.ones((30, 2))), f"ROOT/{CLOUD}: points have the shape (30, 2); they must"),
        (npz(points=np.ones((0, 3))), f"ROOT/{CLOUD}: the file contains no points or is damaged"),
        (write(CLOUD, b""), NO_ARRAY),
        (write(CLOUD, "hello"), NO_ARRAY),
        (cut(CLOUD, 0.5), NO_ARRAY),
        (bare_array, NO_ARRAY),
        (remove("clouds"), "ROOT: no recording here: neither the folder nor one in it has a folder "
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
    assert message == f"ROOT/{name}: the file contains no points or is damaged"


# The layout of UTD-MHAD.


def write_utd(root: Path, name: str = "a1_s1_t1", *, skeleton: bool = True) -> np.ndarray:
    """Two frames of a wall with one near block in the stored image's left half, and its joints."""
    (root / "Depth").mkdir(parents=True, exist_ok=True)
    (root / "Skeleton").mkdir(exist_ok=True)
    depth = np.zeros((240, 320, 2), dtype=np.uint16)
    depth[100:120, 60:80] = 2000
    savemat(root / "Depth" / f"{name}_depth.mat", {"d_depth": depth})
    joints = np.arange(20 * 3 * 2, dtype=float).reshape(20, 3, 2) / 100.0
    if skeleton:
        savemat(root / "Skeleton" / f"{name}_skeleton.mat", {"d_skel": joints})
    return joints


def test_utd_is_turned_round_as_a_whole(tmp_path):
    """What is stored on the left is on the right, for images and joints; y points down."""
    joints = write_utd(tmp_path)
    (found,) = UtdMhad(root=tmp_path).chosen()
    assert (found.name, found.length, found.fps) == ("a1_s1_t1", 2, 30.0)
    frame = next(found.frames())
    assert frame.camera == CAMERA
    assert len(frame.points) == 20 * 20
    np.testing.assert_array_equal(frame.points[:, 2], 2.0)
    pixels = CAMERA.projected(frame.points)
    assert (pixels[:, 0].min(), pixels[:, 0].max()) == pytest.approx((319 - 79, 319 - 60))
    assert (pixels[:, 1].min(), pixels[:, 1].max()) == pytest.approx((100, 119))
    truth = found.truth()
    assert truth.joints == JOINTS
    # The skeletons are one and a half frames ahead, so that both images have the first one.
    for index in range(2):
        np.testing.assert_allclose(truth.positions[index], joints[:, :, 0] * [-1, -1, 1])
    (plain,) = UtdMhad(root=tmp_path, skeleton_lead=0.0).chosen()
    (half,) = UtdMhad(root=tmp_path, skeleton_lead=0.5).chosen()
    stored = np.moveaxis(joints, 2, 0) * [-1, -1, 1]
    np.testing.assert_allclose(plain.truth().positions, stored)
    np.testing.assert_allclose(half.truth().positions[1], stored.mean(axis=0))


def test_utd_joints_of_moving_arms_fit_the_images_best_with_the_lead(utd):
    """Measured on the images alone: how far wrists and hands are from the nearest point."""
    arms = [JOINTS.index(name) for name in ("left_wrist", "left_hand", "right_wrist", "right_hand")]

    def gap(recording) -> float:
        distances = [
            KDTree(frame.points).query(joints[arms])[0].mean()
            for frame, joints in zip(recording.frames(), recording.truth().positions, strict=True)
        ]
        return float(np.mean(distances))

    for name in ("a7_s1_t1", "a9_s2_t1"):
        gaps = {
            lead: gap(UtdMhad(root=utd, recordings=(name,), skeleton_lead=lead).chosen()[0])
            for lead in (0.0, 1.5, 3.0)
        }
        assert gaps[1.5] < 0.85 * min(gaps[0.0], gaps[3.0])


def test_utd_joints_are_twenty_in_the_order_of_the_kinect():
    assert len(set(JOINTS)) == 20
    assert JOINTS[:4] == ("head", "neck", "spine", "pelvis")
    assert JOINTS[4:8] == ("left_shoulder", "left_elbow", "left_wrist", "left_hand")
    assert JOINTS[16:] == ("right_hip", "right_knee", "right_ankle", "right_foot")


def test_utd_recordings_are_sorted_by_number_and_cut(tmp_path):
    for name in ("a19_s1_t1", "a9_s1_t1", "a9_s10_t1", "a9_s2_t1"):
        write_utd(tmp_path, name)
    names = [found.name for found in UtdMhad(root=tmp_path).chosen()]
    assert names == ["a9_s1_t1", "a9_s2_t1", "a9_s10_t1", "a19_s1_t1"]
    (found,) = UtdMhad(root=tmp_path, recordings=("a9_s2_t1",), frames=1).chosen()
    assert found.length == len(list(found.frames())) == len(found.truth().positions) == 1


def test_utd_without_a_skeleton_has_no_truth(tmp_path):
    write_utd(tmp_path, skeleton=False)
    (found,) = UtdMhad(root=tmp_path).chosen()
    assert found.truth() is None


DEPTH, SKELETON = "Depth/a1_s1_t1_depth.mat", "Skeleton/a1_s1_t1_skeleton.mat"


def mat(name: str, **arrays) -> Callable[[Path], None]:
    return lambda folder: savemat(folder / name, arrays)


@pytest.mark.parametrize(
    ("damage", "expected"),
    [
        (remove("Depth"), "ROOT: no recording here: Depth/ must hold files like"),
        (remove(DEPTH), "ROOT: no recording here"),
        (mat(DEPTH, depth=np.ones((240, 320, 2))), f"ROOT/{DEPTH}: not a .mat file with 'd_depth'"),
        (mat(DEPTH, d_depth=np.ones((240, 320))), f"ROOT/{DEPTH}: d_depth has the shape"),
        (mat(DEPTH, d_depth=np.ones((320, 240, 2))), f"ROOT/{DEPTH}: frame 0: the depth image has "
         "240x320 pixels, but the camera has 320x240"),
        (cut(DEPTH, 0.5), f"ROOT/{DEPTH}: not a .mat file with 'd_depth'"),
        (cut(DEPTH, 0.0), f"ROOT/{DEPTH}: not a .mat file with 'd_depth'"),
        (write(DEPTH, "hello"), f"ROOT/{DEPTH}: not a .mat file with 'd_depth'"),
        (write(DEPTH, b"MATLAB 7.3 MAT-file".ljust(124) + b"\x00\x02IM" + bytes(200)),
         f"ROOT/{DEPTH}: not an HDF5 file, or damaged"),
        (mat(SKELETON, skel=np.ones((20, 3, 2))), f"ROOT/{SKELETON}: not a .mat file with "
         "'d_skel'"),
        (mat(SKELETON, d_skel=np.ones((15, 3, 2))), f"ROOT/{SKELETON}: d_skel has the shape "
         "(2, 15, 3), frames first; it must be (2, 20, 3)"),
        (mat(SKELETON, d_skel=np.ones((20, 3, 1))), f"ROOT/{SKELETON}: d_skel has the shape "),
        (mat(SKELETON, d_skel=np.ones((20, 3))), f"ROOT/{SKELETON}: d_skel has the shape (20, 3)"),
        (write(SKELETON, b""), f"ROOT/{SKELETON}: not a .mat file with 'd_skel'"),
    ],
)  # fmt: skip
def test_utd_that_is_wrong_is_told_with_its_place(tmp_path, damage, expected):
    write_utd(tmp_path)
    dataset = UtdMhad(root=tmp_path)
    assert len(everything(dataset)) == 2
    damage(tmp_path)
    assert complaint(dataset, tmp_path).startswith(expected)


@pytest.fixture(scope="session")
def utd(reference_data) -> Path:
    if not (reference_data / "utd_mhad").is_dir():
        pytest.skip("UTD-MHAD is not among the reference data")
    return reference_data / "utd_mhad"


def test_utd_reference_data_are_found_with_their_joints(utd):
    found = UtdMhad(root=utd).chosen()
    assert len(found) == len(list((utd / "Depth").iterdir())) == 14
    assert [recording.name for recording in found][:2] == ["a1_s1_t1", "a1_s2_t1"]
    for recording in found:
        assert recording.length > 30
        truth = recording.truth()
        assert len(truth.positions) == recording.length
        assert np.isfinite(truth.positions).all()


def test_utd_people_are_no_mirror_images(utd):
    """Facing the camera, a person's left is on the image's right, the head above the feet."""
    for recording in UtdMhad(root=utd).chosen():
        joints = dict(zip(JOINTS, np.moveaxis(recording.truth().positions, 1, 0), strict=True))
        assert (joints["left_shoulder"][:, 0] > joints["right_shoulder"][:, 0]).mean() > 0.9
        assert joints["head"][:, 1].mean() < joints["left_foot"][:, 1].mean()


def test_utd_joints_lie_near_the_cloud(utd):
    """Were only one of the two turned round, arms would be beside the body's points."""

    def gap(joints: np.ndarray, points: np.ndarray) -> float:
        return np.median(np.linalg.norm(joints[:, None] - points[None], axis=2).min(axis=1))

    gaps, mirrored = [], []
    for recording in UtdMhad(root=utd, frames=1).chosen():
        points = next(recording.frames()).points
        joints = recording.truth().positions[0]
        gaps.append(gap(joints, points))
        mirrored.append(gap(joints * [-1.0, 1.0, 1.0], points))
        assert 1.0 < points[:, 2].min() < points[:, 2].max() < 5.0
    assert max(gaps) < 0.15
    assert np.mean(gaps) < 0.7 * np.mean(mirrored)
