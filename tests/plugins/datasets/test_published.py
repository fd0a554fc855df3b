"""Published data sets' layouts, read from small files that are made in them."""

import re
import sys
from pathlib import Path

import h5py
import numpy as np
import pytest
from places import ROOT
from public_layouts import (
    FRAMES,
    SMALL,
    SQUARE,
    WALL,
    body,
    depth_image,
    square,
    write_itop,
    write_pdt13,
    write_records,
)
from pydantic import ValidationError
from scipy.io import savemat

from regkit.config.document import Document
from regkit.experiment import Experiment
from regkit.interfaces import Dataset, Recording
from regkit.metrics import matched
from regkit.observation import Frame
from regkit.system.errors import DependencyError, RegkitError
from regkit_plugins.datasets.eval import Eval
from regkit_plugins.datasets.formats.organized_clouds.records import RecordLayout
from regkit_plugins.datasets.itop.itop import CAMERA, Itop
from regkit_plugins.datasets.pdt13 import Intrinsics, Pdt13
from regkit_plugins.datasets.smmc10 import Smmc10
from regkit_plugins.datasets.utd_mhad import UtdMhad
from regkit_plugins.templates.human import Human

RECORD = RecordLayout(width=SMALL.width, height=SMALL.height)
EXACT = Intrinsics(focal_px=36.0, centre_px=(19.0, 15.5))
PAGE = ROOT / "docs" / "reference" / "datasets.md"


def only(dataset: Dataset) -> Recording:
    (recording,) = dataset.chosen()
    return recording


def complaint(dataset: Dataset, root: Path) -> str:
    def read() -> None:
        for recording in dataset.chosen():
            recording.truth()
            list(recording.frames())

    with pytest.raises(RegkitError) as caught:
        read()
    return str(caught.value).replace(str(root), "ROOT")


def assert_is_scene(frames: list[Frame], *, atol: float = 1e-5) -> None:
    """The whole scene, as it is in the camera's frame."""
    assert len(frames) == FRAMES
    for index, frame in enumerate(frames):
        depth = depth_image(index)
        np.testing.assert_allclose(frame.depth, depth, atol=atol)
        np.testing.assert_allclose(frame.points, SMALL.back_projected(depth), atol=atol)
        pixels = frame.camera.projected(frame.points)
        rows, columns = np.nonzero(depth)
        np.testing.assert_allclose(pixels, np.column_stack([columns, rows]), atol=1e-3)


# EVAL and SMMC-10: organized clouds.


@pytest.fixture
def records(tmp_path) -> Path:
    write_records(tmp_path / "seq_b_3.bin", RECORD)
    return tmp_path


def test_record_of_eval_has_the_size_that_the_public_loader_reads():
    assert Eval(root=".").record.dtype.itemsize == 930_704


def test_eval_frames_are_in_the_cameras_frame_with_the_camera_that_took_them(records):
    recording = only(Eval(root=records, record=RECORD))
    assert (recording.name, recording.subject, recording.length) == ("seq_b_3", "b", FRAMES)
    frames = list(recording.frames())
    assert_is_scene(frames)
    camera = frames[0].camera
    found = (camera.fx, camera.fy, camera.cx, camera.cy)
    np.testing.assert_allclose(found, (SMALL.fx, SMALL.fy, SMALL.cx, SMALL.cy), atol=1e-3)


def test_eval_truth_has_markers_by_name_and_joints_by_number(records):
    truth = only(Eval(root=records, record=RECORD)).truth()
    assert truth.joints == ("left_hand", "right_hand", "joint_7")
    for index in range(FRAMES):
        expected = body(index)
        np.testing.assert_allclose(truth.positions[index, 0], expected["left_hand"], atol=1e-6)
        np.testing.assert_allclose(truth.positions[index, 2], expected["head"], atol=1e-6)
    assert np.isnan(truth.positions[1, 1]).all()
    assert np.isfinite(truth.positions[[0, 2, 3], 1]).all()
    # Who faces the camera has the left hand on the image's right, and the head above both.
    assert (truth.positions[:, 0, 0] > truth.positions[:, 2, 0]).all()
    assert (truth.positions[:, 2, 1] < truth.positions[:, 0, 1]).all()


@pytest.mark.parametrize(
    ("signs", "axes"),
    [
        ((1, 1, 1), ("x", "y", "z")),
        ((-1, -1, 1), ("-x", "-y", "z")),
        ((-1, 1, -1), ("-x", "y", "-z")),
    ],
)
def test_axes_say_how_points_and_markers_were_stored(tmp_path, signs, axes):
    write_records(tmp_path / "seq_a.bin", RECORD, signs)
    recording = only(Eval(root=tmp_path, record=RECORD, axes=axes))
    assert_is_scene(list(recording.frames()))
    np.testing.assert_allclose(recording.truth().positions[0, 0], body(0)["left_hand"], atol=1e-6)


def test_images_stored_as_in_a_mirror_are_turned_round(records):
    """With x the other way, x still grows along the columns, of images and camera."""
    straight = list(only(Eval(root=records, record=RECORD)).frames())
    turned = list(only(Eval(root=records, record=RECORD, axes=("-x", "-y", "-z"))).frames())
    for one, other in zip(straight, turned, strict=True):
        np.testing.assert_array_equal(other.depth, one.depth[:, ::-1])
        pixels = other.camera.projected(other.points)
        rows, columns = np.nonzero(other.depth)
        np.testing.assert_allclose(pixels, np.column_stack([columns, rows]), atol=1e-3)


@pytest.mark.parametrize("axes", [("x", "x", "z"), ("x", "y", "-y"), ("x", "y"), ("x", "y", "w")])
def test_axes_that_are_no_three_directions_are_refused(axes):
    with pytest.raises(ValidationError):
        Eval(root=".", axes=axes)


def test_foreground_is_what_moves_before_the_wall(records):
    frames = list(only(Eval(root=records, record=RECORD, foreground=0.5)).frames())
    for index, frame in enumerate(frames):
        expected = np.zeros((SMALL.height, SMALL.width))
        expected[square(index)] = SQUARE
        np.testing.assert_allclose(frame.depth, expected, atol=1e-6)
        assert len(frame.points) == np.count_nonzero(expected)


def test_frames_limit_cuts_frames_and_truth_but_not_what_tells_the_background(records):
    recording = only(Eval(root=records, record=RECORD, foreground=0.5, frames=1))
    (frame,) = recording.frames()
    assert len(frame.points) == np.count_nonzero(depth_image(0) == SQUARE)
    assert recording.truth().positions.shape == (1, 3, 3)


def test_frames_without_a_camera_are_clouds(records):
    frame = next(only(Eval(root=records, record=RECORD, camera=False)).frames())
    assert frame.camera is None
    assert frame.depth is None
    np.testing.assert_allclose(frame.points, SMALL.back_projected(depth_image(0)), atol=1e-5)


def test_smmc10_is_read_like_eval_at_its_cameras_size(records):
    assert (Smmc10(root=".").record.width, Smmc10(root=".").record.height) == (176, 144)
    recording = only(Smmc10(root=records, record=RECORD))
    assert (recording.subject, recording.fps) == (None, 25.0)
    assert_is_scene(list(recording.frames()))
    assert only(Smmc10(root=records, record=RECORD, subjects="seq_(.)")).subject == "b"


@pytest.mark.parametrize("pattern", ["seq_.", "(a)(b)", "("])
def test_subject_pattern_must_have_one_group(pattern):
    with pytest.raises(ValidationError, match=r"group|regular expression"):
        Smmc10(root=".", subjects=pattern)


def test_records_that_are_wrong_are_told_with_their_place(records):
    path = records / "seq_b_3.bin"
    whole = path.read_bytes()
    dataset = Eval(root=records, record=RECORD)
    at = "ROOT/seq_b_3.bin"
    assert complaint(Eval(root=records, files="x*"), records) == (
        "ROOT: no recording here: no file matches 'x*' (dataset.files)"
    )
    assert complaint(Eval(root=records), records).startswith(
        f"{at}: the file's {len(whole)} bytes are not a multiple of the record's 930704 bytes"
    )
    assert complaint(Eval(root=records, record=RECORD, axes=("x", "-y", "z")), records).startswith(
        f"{at}: frame 0: only 0 points lie in front of the camera"
    )
    assert "no pinhole camera fits the grid of points" in complaint(
        Eval(root=records, record=RECORD, axes=("y", "x", "-z")), records
    )
    count = RECORD.dtype.fields["marker_count"][1]
    path.write_bytes(whole[:count] + b"\xff\x00\x00\x00" + whole[count + 4 :])
    assert complaint(dataset, records).startswith(
        f"{at}: frame 0: marker_count is 255, for 32 slots"
    )
    path.write_bytes(b"")
    assert complaint(dataset, records).startswith(f"{at}: the file's 0 bytes are not a multiple")


# ITOP.


def test_itop_recordings_are_runs_of_valid_frames_of_one_person(tmp_path):
    write_itop(tmp_path)
    found = Itop(root=tmp_path).chosen()
    assert [(one.name, one.subject, one.length) for one in found] == [
        ("00_00000", "00", 1), ("00_00002", "00", 1), ("03_00005", "03", 2), ("03_00008", "03", 1),
        ("11_00000", "11", 1),
    ]  # fmt: skip
    wider = Itop(root=tmp_path, gap=2).chosen()
    assert [one.length for one in wider] == [2, 3, 1]
    kept = Itop(root=tmp_path, background="kept").chosen()
    assert [one.length for one in kept] == [3, 2, 1, 1]
    (cut,) = Itop(root=tmp_path, gap=2, frames=2, recordings=("03_00005",)).chosen()
    assert len(list(cut.frames())) == len(cut.truth().positions) == 2


def test_itop_keeps_the_person_alone_or_the_room_with_it(tmp_path):
    write_itop(tmp_path)
    frames = list(Itop(root=tmp_path).chosen()[2].frames())
    for index, frame in zip((3, 4), frames, strict=True):
        rows, columns = square(index, CAMERA)
        assert len(frame.points) == (rows.stop - rows.start) * (columns.stop - columns.start)
        np.testing.assert_array_equal(frame.points[:, 2], SQUARE)
        assert frame.place.endswith(f"ITOP_side_test_depth_map.h5: data[{index}]")
        pixels = CAMERA.projected(frame.points)
        assert (pixels.min(axis=0).round() == (columns.start, rows.start)).all()
    room = next(Itop(root=tmp_path, background="kept").chosen()[0].frames())
    assert len(room.points) == 320 * 240 - 1
    assert set(np.unique(room.points[:, 2])) == {SQUARE, WALL}


def test_itop_joints_are_seen_where_the_published_formula_says(tmp_path):
    """u = 160 + x / 0.0035 z and v = 120 - y / 0.0035 z of the stored joints."""
    write_itop(tmp_path)
    with h5py.File(tmp_path / "ITOP_side_test_labels.h5") as file:
        x, y, z = np.moveaxis(file["real_world_coordinates"][3:5, [0, 6, 7]], 2, 0)
    recording = Itop(root=tmp_path).chosen()[2]
    truth = recording.truth()
    columns = [truth.joints.index(name) for name in ("head", "right_hand", "left_hand")]
    pixels = CAMERA.projected(truth.positions[:, columns].reshape(-1, 3)).reshape(2, 3, 2)
    np.testing.assert_allclose(pixels[..., 0], 160 + x / (0.0035 * z), atol=1e-3)
    np.testing.assert_allclose(pixels[..., 1], 120 - y / (0.0035 * z), atol=1e-3)
    head, right, left = truth.positions[0, columns]
    assert right[0] < head[0] < left[0]
    assert head[1] < left[1]


def test_itop_joints_that_people_refused_are_not_scored(tmp_path):
    write_itop(tmp_path)
    positions = Itop(root=tmp_path, background="kept").chosen()[0].truth().positions
    assert np.isnan(positions[1]).all()
    assert np.isfinite(positions[[0, 2]]).all()


def test_itop_in_a_mirror_is_turned_round_as_a_whole(tmp_path):
    write_itop(tmp_path, view="top", split="train")
    options = {"root": tmp_path, "view": "top", "split": "train"}
    one, other = (Itop(**options, mirrored=flag).chosen()[2] for flag in (False, True))
    sign = np.array([-1.0, 1.0, 1.0])
    np.testing.assert_allclose(other.truth().positions, one.truth().positions * sign, atol=1e-12)
    first, second = next(one.frames()), next(other.frames())
    np.testing.assert_array_equal(second.depth, first.depth[:, ::-1])
    points = {tuple(point) for point in (first.points * sign).round(9)}
    assert points == {tuple(point) for point in second.points.round(9)}


def test_itop_frames_are_read_one_by_one(tmp_path, monkeypatch):
    write_itop(tmp_path)
    from regkit_plugins.datasets.formats import hdf5

    asked, read = [], hdf5.read
    monkeypatch.setattr(
        hdf5, "read", lambda array, where=(): asked.append(where) or read(array, where)
    )
    frames = Itop(root=tmp_path).chosen()[2].frames()
    asked.clear()
    next(frames)
    assert asked == [3, 3]


def test_itop_that_is_wrong_is_told_with_its_file_and_array(tmp_path, monkeypatch):
    images, labels = "ROOT/ITOP_side_test_depth_map.h5", "ROOT/ITOP_side_test_labels.h5"
    dataset = Itop(root=tmp_path)
    assert complaint(dataset, tmp_path) == f"{images}: there is no such file"
    write_itop(tmp_path)

    def damaged(name: str, array: str, values: np.ndarray | None) -> str:
        write_itop(tmp_path)
        with h5py.File(tmp_path / name, "r+") as file:
            del file[array]
            if values is not None:
                file[array] = values
        return complaint(dataset, tmp_path)

    depth, label = "ITOP_side_test_depth_map.h5", "ITOP_side_test_labels.h5"
    assert damaged(depth, "data", None) == f"{images}: no array 'data' in the file (there are: id)"
    assert damaged(depth, "data", np.ones((7, 24, 32))) == (
        f"{images}: data[0] has the shape (24, 32); it must be (240, 320)"
    )
    assert damaged(depth, "id", np.array(["00_00000", "x"], dtype="S8")).startswith(
        f"{labels}: is_valid has 7 entries, but ITOP_side_test_depth_map.h5 holds 2 frames"
    )
    assert damaged(depth, "id", np.array(["walk"] * 7, dtype="S8")) == (
        f"{images}: id[0] is 'walk'; it must consist of person and frame, as in 02_00143"
    )
    assert (
        damaged(label, "is_valid", np.zeros(7)) == f"{labels}: no frame is marked valid (is_valid)"
    )
    assert damaged(label, "real_world_coordinates", np.zeros((7, 20, 3))).startswith(
        f"{labels}: real_world_coordinates has the shape (7, 20, 3); it must be (N, 15, 3)"
    )
    (tmp_path / label).write_bytes(b"no HDF5")
    assert complaint(dataset, tmp_path).startswith(f"{labels}: not an HDF5 file, or damaged")
    monkeypatch.setitem(sys.modules, "h5py", None)
    with pytest.raises(DependencyError, match=re.escape("pip install 'regkit[hdf5]'")):
        dataset.chosen()


# PDT-13.


@pytest.mark.parametrize("hdf5", [False, True])
def test_pdt13_is_read_from_matlab_files_of_both_kinds(tmp_path, hdf5):
    write_pdt13(tmp_path, hdf5=hdf5)
    recording = only(Pdt13(root=tmp_path, intrinsics=EXACT, joint_names=tuple(body(0))))
    assert (recording.name, recording.subject, recording.length) == ("M2_D1", "M2", FRAMES)
    frames = list(recording.frames())
    for index, frame in enumerate(frames):
        np.testing.assert_allclose(frame.depth, depth_image(index))
        assert frame.camera.fx == frame.camera.fy == 36.0
    truth = recording.truth()
    assert truth.joints == ("head", "left_hand", "right_hand")
    np.testing.assert_allclose(truth.positions[3, 1], body(3)["left_hand"])
    assert np.isnan(truth.positions[1, 0]).all()


def test_pdt13_units_directions_and_mirror_are_as_set(tmp_path):
    write_pdt13(tmp_path)
    plain = only(Pdt13(root=tmp_path, intrinsics=EXACT))
    other = only(
        Pdt13(
            root=tmp_path,
            intrinsics=EXACT,
            depth_scale=500.0,
            joint_scale=500.0,
            joint_axes=("-x", "y", "z"),
            mirrored=True,
        )
    )
    first, second = next(plain.frames()), next(other.frames())
    np.testing.assert_allclose(second.depth, 2.0 * first.depth[:, ::-1])
    assert second.camera.cx == SMALL.width - 1 - 19.0
    turned = {tuple(point) for point in (first.points * [-2.0, 2.0, 2.0]).round(9)}
    assert turned == {tuple(point) for point in second.points.round(9)}
    sign = np.array([-2.0, 2.0, 2.0])
    np.testing.assert_allclose(other.truth().positions, plain.truth().positions * sign)


def test_pdt13_that_is_wrong_is_told_with_its_file_and_array(tmp_path):
    assert complaint(Pdt13(root=tmp_path), tmp_path) == (
        "ROOT: no recording here: no file ends with '_depth.mat' (dataset.depth_suffix)"
    )
    write_pdt13(tmp_path)
    at = "ROOT/M2_D1_depth.mat"
    assert complaint(Pdt13(root=tmp_path, depth_array="z"), tmp_path).startswith(
        f"{at}: not a .mat file with 'z'"
    )
    assert complaint(Pdt13(root=tmp_path), tmp_path).startswith(
        f"{at}: dataset.intrinsics: the principal point cx is 319.5"
    )
    one = Pdt13(root=tmp_path, joint_names=("head",), intrinsics=EXACT)
    assert complaint(one, tmp_path) == (
        "ROOT/M2_D1_joints.mat: joints has the shape (3, 3, 4); it must be (1, 3, 4): positions, "
        "axes, frames"
    )
    savemat(tmp_path / "M2_D1_depth.mat", {"depth": np.ones((3, 4))})
    assert complaint(Pdt13(root=tmp_path), tmp_path) == (
        f"{at}: depth has the shape (3, 4); it must have three axes, the frames last"
    )
    (tmp_path / "M2_D1_depth.mat").write_bytes(b"MATLAB 7.3 MAT-file".ljust(600))
    assert complaint(Pdt13(root=tmp_path), tmp_path).startswith(
        f"{at}: not an HDF5 file, or damaged"
    )


# All of them.


def test_utd_subject_is_told_by_the_name(tmp_path):
    (tmp_path / "Depth").mkdir()
    for name in ("a1_s3_t1", "a12_s8_t4"):
        savemat(tmp_path / "Depth" / f"{name}_depth.mat", {"d_depth": np.ones((240, 320, 1))})
    assert [found.subject for found in UtdMhad(root=tmp_path).chosen()] == ["s3", "s8"]


def test_examples_of_the_page_read_files_in_their_layout(tmp_path):
    """Each YAML of the page is an experiment, and its joints are markers of its template."""
    examples = re.findall(r"```yaml\n(.*?)```", PAGE.read_text(encoding="utf-8"), re.DOTALL)
    kinds = []
    for number, text in enumerate(examples):
        path = tmp_path / f"{number}.yaml"
        path.write_text(text)
        kind = Document.read(path).data["dataset"]["kind"]
        root = tmp_path / kind
        dataset = make_small(kind, root)
        experiment = Experiment.read(path, [f"dataset.root={root}", *dataset])
        kinds.append(kind)
        for recording in experiment.dataset.chosen():
            truth = recording.truth()
            assert len(next(recording.frames()).points) > 0
            if experiment.dataset.compared:
                columns, markers = matched(Human().body(1.75), truth, experiment.dataset.joints)
                assert len(columns) == len(set(markers)) >= 3
    assert kinds == ["utd_mhad", "itop", "eval", "smmc10", "pdt13"]


def make_small(kind: str, root: Path) -> list[str]:
    """Write small files; answer with the settings that tell how small they are."""
    record = [f"dataset.record.width={SMALL.width}", f"dataset.record.height={SMALL.height}"]
    if kind == "itop":
        write_itop(root)
    elif kind == "pdt13":
        write_pdt13(root)
        return ["dataset.intrinsics={focal_px: 36, centre_px: [19, 15.5]}"]
    elif kind in ("eval", "smmc10"):
        write_records(root / "seq_a_0.bin", RECORD)
        return record
    else:
        for folder, name, values in (
            ("Depth", "depth", np.full((240, 320, 3), 2000)),
            ("Skeleton", "skel", np.ones((20, 3, 3))),
        ):
            (root / folder).mkdir(parents=True)
            file = "depth" if name == "depth" else "skeleton"
            savemat(root / folder / f"a1_s1_t1_{file}.mat", {f"d_{name}": values})
    return []
