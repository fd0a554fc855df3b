"""Depth images in folders: what is read, and what is said of files that are wrong."""

import zlib
from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest
from damage import complaint, cut, everything, remove, write
from messages import tells
from PIL import Image

from regkit.geometry.camera import Camera
from regkit.system.errors import ConfigError, DataError
from regkit_plugins.datasets.depth import DepthFolders

SMALL = Camera(width=24, height=18, fx=20.0, fy=22.0, cx=11.5, cy=8.5)
FRAMES = 3
CASES = Path(__file__).parents[2] / "cases"


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


@pytest.fixture
def recording(tmp_path) -> Path:
    return write_recording(tmp_path / "one")


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
    words = ("'wlak'", "jump, renamed, sit, walk", "did you mean 'walk'?")
    assert tells(str(caught.value), at="dataset.recordings", of=words)


def test_recordings_of_the_same_name_are_refused(tmp_path):
    for folder in ("a", "b"):
        write_recording(tmp_path / folder, "name: same\n")
    message = complaint(DepthFolders(root=tmp_path), tmp_path)
    assert tells(message, at="dataset", of=("two recordings", "'same'"))


def image(name: str, pixels: np.ndarray) -> Callable[[Path], None]:
    return lambda folder: Image.fromarray(pixels).save(folder / name)


HEADER = "frame,joint,x,y,z\n"
SECOND = "depth/000001.png"


def chunk(kind, content):
    """Returns a chunk of a PNG file."""
    check = zlib.crc32(kind + content).to_bytes(4, "big")
    return len(content).to_bytes(4, "big") + kind + content + check


def zipped_text(path):
    """Adds a text to an image that unpacks to 100 MB."""
    bomb = chunk(b"zTXt", b"a\0\0" + zlib.compress(bytes(100_000_000), 9))
    content = path.read_bytes()
    path.write_bytes(content[:33] + bomb + content[33:])


def announcing(path, width, height):
    """Changes the size that an image announces."""
    content = path.read_bytes()
    size = width.to_bytes(4, "big") + height.to_bytes(4, "big") + content[24:29]
    path.write_bytes(content[:8] + chunk(b"IHDR", size) + content[33:])


@pytest.mark.parametrize(
    ("damage", "expected"),
    [
        (remove(), "ROOT: there is no such folder"),
        (remove("depth"), "ROOT: no recording here: neither this folder nor one in it contains "
         "'depth/' beside a sequence.yaml"),
        (remove("sequence.yaml"), "ROOT/sequence.yaml: there is no such file"),
        (remove(SECOND), "ROOT/depth: files must be numbered from 000000 without gaps; 000001 is "
         "missing before 000002.png"),
        (remove("depth", "000000.png"), "ROOT/depth: files must be numbered from 000000 without "
         "gaps; 000000 is missing before 000001.png"),
        (lambda folder: [path.unlink() for path in (folder / "depth").iterdir()],
         "ROOT/depth: the folder holds no .png file"),
        (cut(SECOND, 0.6), "ROOT/depth/000001.png: not a PNG depth image, or cut short: "),
        (cut(SECOND, 0.0), "ROOT/depth/000001.png: not a PNG depth image, or cut short: "),
        (write(SECOND, "hello"), "ROOT/depth/000001.png: not a PNG depth image, or cut short: "),
        (image(SECOND, np.ones((18, 24), np.uint8)), "ROOT/depth/000001.png: a depth image has one "
         "channel of 16 bits; this one is of the mode L"),
        (image(SECOND, np.ones((18, 24, 3), np.uint8)), "ROOT/depth/000001.png: a depth image has "
         "one channel of 16 bits; this one is of the mode RGB"),
        (image(SECOND, np.ones((24, 18), np.uint16)), "ROOT/depth/000001.png: the depth image has "
         "18x24 pixels, but the camera has 24x18"),
        (remove("camera.json"), "ROOT/camera.json: the file is missing; it should hold "
         "the camera's intrinsics"),
        (cut("camera.json", 0.5), "ROOT/camera.json:6: not JSON"),
        (write("camera.json", b"\xff\xfe"), "ROOT/camera.json: not a JSON file"),
        (write("camera.json", "[1, 2]"), "ROOT/camera.json: must be a JSON object"),
        (write("camera.json", '{"width": 24, "height": 18}'), "ROOT/camera.json: not a camera "
         "file: intrinsic_matrix missing; it must have width, height and intrinsic_matrix"),
        (write("camera.json", '{"width": 24, "height": 18, "intrinsic_matrix": [1, 2]}'),
         "ROOT/camera.json: the matrix must be 9 numbers"),
        (write("camera.json", SMALL.to_json().replace("20.0", "-20.0")),
         "ROOT/camera.json: the focal length fx is -20 px"),
        (write("sequence.yaml", "name: x\nfpss: 15\n"), "ROOT/sequence.yaml:2: fpss: no such field "
         "(there are: depth_scale, fps, licence, name, source); did you mean 'fps'?"),
        (write("sequence.yaml", "fps: 0\n"), "ROOT/sequence.yaml:1: fps: input should be greater "),
        (write("sequence.yaml", "fps: 5\ndepth_scale: mm\n"), "ROOT/sequence.yaml:2: depth_scale: "
         "input should be a valid number"),
        (write("sequence.yaml", "name: ../../elsewhere\n"), "ROOT/sequence.yaml:1: name: string "
         "should match"),
        (write("truth.csv", "frame,joint,x,y\n"), "ROOT/truth.csv:1: the header must be "
         "frame,joint,x,y,z; it is frame,joint,x,y"),
        (write("truth.csv", ""), "ROOT/truth.csv:1: the header must be frame,joint,x,y,z; it is "),
        (write("truth.csv", b"\xff\xfe\x00"), "ROOT/truth.csv: damaged text"),
        (write("truth.csv", HEADER + "0,a,1,2,3\n0,b,1,2\n"), "ROOT/truth.csv:3: not a row of "
         "frame,joint,x,y,z: 0,b,1,2"),
        (write("truth.csv", HEADER + "0,a,1,2,3,4\n"), "ROOT/truth.csv:2: not a row of"),
        (write("truth.csv", HEADER + "0,a,1,2,far\n"), "ROOT/truth.csv:2: not a row of "
         "frame,joint,x,y,z: 0,a,1,2,far"),
        (write("truth.csv", HEADER + "-1,a,1,2,3\n"), "ROOT/truth.csv:2: not a row of "
         "frame,joint,x,y,z: -1,a,1,2,3"),
        (write("truth.csv", HEADER + "0,a,1,nan,3\n"), "ROOT/truth.csv:2: a position is NaN or "
         "infinite; omit the row"),
        (write("truth.csv", HEADER + "0,a,1,2,3\n0,a,1,2,3\n"), "ROOT/truth.csv:3: joint 'a' of"),
        (write("truth.csv", HEADER + "0,a,1,2,1_0\n"), "ROOT/truth.csv:2: not a row of"),
        (write("truth.csv", HEADER + "0,,1,2,3\n"), "ROOT/truth.csv:2: not a row of"),
        (write("truth.csv", HEADER + "0,a,1,2,1e300\n"), "ROOT/truth.csv:2: a position is beyond"),
        (write("truth.csv", HEADER + "9" * 5000 + ",a,1,2,3\n"), "ROOT/truth.csv:2: not a row of"),
        (write("truth.csv", HEADER + "0,a,1,2\x00,3\n"), "ROOT/truth.csv:2: a NUL byte"),
        (write("truth.csv", HEADER + "0," + "a" * 200_000 + ",1,2,3\n"), "ROOT/truth.csv:2: not a"),
        (write("truth.csv", HEADER.replace(",", ";")), "ROOT/truth.csv:1: the header must be"),
        (lambda folder: zipped_text(folder / SECOND), "ROOT/depth/000001.png: not a PNG depth"),
        (lambda folder: announcing(folder / SECOND, 30_000, 30_000), "ROOT/depth/000001.png: not a "
         "PNG depth image, or cut short: Image size"),
        (lambda folder: announcing(folder / SECOND, 9_000, 9_000), "ROOT/depth/000001.png: the "
         "image announces 9000x9000 pixels"),
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


@pytest.mark.parametrize("name", ["walk_rows_3x3", "by_rows_flat"])
def test_matrix_by_rows_puts_the_points_where_the_body_is(name):
    """Read by columns, the principal point is the corner, and the body a metre to the side."""
    (recording,) = DepthFolders(root=CASES / "11-intrinsics" / name).chosen()
    truth = recording.truth()
    for index, frame in enumerate(recording.frames()):
        centre = frame.points.mean(axis=0)
        joints = [0.0, 0.0] if truth is None else np.nanmean(truth.positions[index], axis=0)[:2]
        np.testing.assert_allclose(centre[:2], joints, atol=0.15)
        assert (frame.camera.cx, frame.camera.cy) != (0.0, 0.0)
