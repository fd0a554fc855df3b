"""Keypoints of detectors: their files, their names, and their sides."""

import json
from dataclasses import replace

import numpy as np
import pytest

import regkit
from regkit import Keypoints, load_keypoints
from regkit.geometry.camera import Camera
from regkit.interfaces import Dataset, Template
from regkit.observation.sides import with_consistent_sides
from regkit.recording.keypoints.detectors import detectors
from regkit.system.errors import RegkitError
from regkit.system.shipped import examples_folder

CAMERA = Camera(width=200, height=100, fx=100.0, fy=100.0, cx=99.5, cy=49.5)


def write(path, *lines):
    path.write_text("\n".join(lines) + "\n")
    return path


def walk(frames=40, seed=0):
    """Left and right of a person who walks and swings, in the picture."""
    random = np.random.default_rng(seed)
    names = tuple(f"{s}_{j}" for s in ("left", "right") for j in ("hip", "knee", "wrist"))
    time = np.linspace(0.0, 6.0, frames)[:, None]
    side = np.array([1.0, 1.0, 1.0, -1.0, -1.0, -1.0])
    across = 100.0 + side * [10.0, 10.0, 20.0, 10.0, 10.0, 20.0] + 15.0 * np.sin(time)
    down = np.array([40.0, 60.0, 45.0] * 2) + 8.0 * side * np.sin(2.0 * time)
    pixels = np.stack([across, down], axis=2) + random.normal(scale=1.0, size=(frames, 6, 2))
    return Keypoints.in_picture(names, pixels), random


def exchanged(keypoints, frames):
    pixels = keypoints.pixels.copy()
    pixels[frames] = pixels[frames][:, [3, 4, 5, 0, 1, 2]]
    return replace(keypoints, pixels=pixels)


def test_csv_tells_space_from_picture_by_its_header(tmp_path):
    flat = write(tmp_path / "a.csv", "frame,name,x,y,confidence", "2,LKnee,10,20,0.5")
    found = load_keypoints(flat)
    assert found.names == ("left_knee",)
    marks = found.landmarks(2, CAMERA)
    np.testing.assert_array_equal(marks.pixels, [[10.0, 20.0]])
    assert np.isnan(marks.positions).all()
    assert marks.confidences == [0.5]
    assert found.landmarks(0, CAMERA) is None
    space = write(tmp_path / "b.csv", "frame,name,x,y,z,confidence", "0,nose,0.1,0.2,3,1")
    np.testing.assert_array_equal(load_keypoints(space).positions, [[[0.1, 0.2, 3.0]]])


def test_openpose_takes_the_surest_person_and_leaves_out_what_it_did_not_find(tmp_path):
    unsure, sure = [1.0, 2.0, 0.3] * 25, [3.0, 4.0, 0.8] * 24 + [0.0, 0.0, 0.0]
    people = [{"pose_keypoints_2d": one} for one in (unsure, sure)]
    (tmp_path / "x_000000000007_keypoints.json").write_text(json.dumps({"people": people}))
    (tmp_path / "x_000000000008_keypoints.json").write_text(json.dumps({"people": []}))
    with pytest.warns(regkit.RegkitWarning, match="several people"):
        found = load_keypoints(tmp_path)
    assert found.numbers.tolist() == [7]
    assert "RHeel" not in found.names
    assert (found.landmarks(7, CAMERA).pixels == [3.0, 4.0]).all()


def test_mediapipe_is_in_fractions_of_the_image(tmp_path):
    marks = [{"x": 0.5, "y": 0.25, "z": -0.3, "visibility": 0.9}] * 33
    path = tmp_path / "pose.json"
    path.write_text(json.dumps({"frames": [{"frame": 3, "landmarks": marks}]}))
    np.testing.assert_allclose(
        load_keypoints(path).landmarks(3, CAMERA).pixels, [[99.5, 24.5]] * 33
    )


@pytest.mark.parametrize(("prefix", "template"), [
    ("mediapipe_pose", "human"), ("openpose", "human"), ("mediapipe_hand", "hand"),
])  # fmt: skip
def test_detectors_name_markers_of_the_shipped_templates(prefix, template):
    loaded = Template.parse(template, place="test", field="template")
    names = loaded.body(loaded.candidate_sizes()[0]).markers.names
    named = [one for name, one in detectors().items() if name.startswith(prefix)]
    assert named
    for one in named:
        markers = [marker for marker in one.values() if marker is not None]
        assert len(markers) == len(set(markers))
        assert len(markers) >= 12
        assert set(markers) <= set(names)


@pytest.mark.parametrize(
    ("lines", "said"),
    [
        (["frame,name,x,y"], r":1: the header"),
        (["frame,name,x,y,confidence", "0,a,1,2"], r":2: not a row"),
        (["frame,name,x,y,confidence", "0,a,1,2,1", "-1,a,1,2,1"], r":3: not a row"),
        (["frame,name,x,y,confidence", "0,a,nan,2,1"], r":2: no keypoint"),
        (["frame,name,x,y,confidence", "0,a,1,2,-1"], r":2: the confidence"),
        (["frame,name,x,y,confidence", "0,LKnee,1,2,1", "0,left_knee,1,2,1"], r":3: .*two"),
        (["frame,name,x,y,confidence"], r"no keypoint in it"),
    ],
)
def test_damaged_csv_is_refused_at_its_line(tmp_path, lines, said):
    with pytest.raises(RegkitError, match=said):
        load_keypoints(write(tmp_path / "k.csv", *lines))


def test_number_too_large_is_refused_with_its_file(tmp_path):
    marks = [{"x": 10**400, "y": 0.5}] + 32 * [{"x": 0.5, "y": 0.5}]
    path = tmp_path / "marks.json"
    path.write_text(json.dumps({"frames": [{"landmarks": marks}]}))
    with pytest.raises(RegkitError, match=r"marks\.json.*not a finite number"):
        load_keypoints(path)


def test_unknown_keypoint_of_a_map_and_unknown_formats_are_told(tmp_path):
    path = write(tmp_path / "k.csv", "frame,name,x,y,confidence", "0,nose,1,2,1")
    assert load_keypoints(path, {"nose": "head"}).names == ("head",)
    with pytest.raises(RegkitError, match=r"'ear'.*nose"):
        load_keypoints(path, {"ear": "head"})
    with pytest.raises(RegkitError, match="no such file"):
        load_keypoints(tmp_path / "none.csv")
    with pytest.raises(RegkitError, match="OpenPose"):
        load_keypoints(write(tmp_path / "k.txt", "x"))


@pytest.mark.parametrize("seed", range(4))
def test_exchanged_sides_are_found(seed):
    keypoints, random = walk(seed=seed)
    frames = random.random(len(keypoints.numbers)) < 0.2
    found, count = with_consistent_sides(exchanged(keypoints, frames))
    assert count == frames.sum() > 0
    np.testing.assert_array_equal(found.pixels, keypoints.pixels)


def test_sides_survive_outliers_gaps_and_stay_where_nothing_is_exchanged():
    keypoints, random = walk(seed=9)
    pixels = keypoints.pixels.copy()
    wrong = random.random(pixels.shape[:2]) < 0.2
    pixels[wrong] = random.uniform([0, 0], [200, 100], (int(wrong.sum()), 2))
    pixels[5:8] = np.nan
    given = replace(keypoints, pixels=pixels)
    found, count = with_consistent_sides(given)
    assert count == 0
    np.testing.assert_array_equal(found.pixels, pixels)
    frames = np.isin(np.arange(40), [12, 13, 30])
    np.testing.assert_array_equal(with_consistent_sides(exchanged(given, frames))[0].pixels, pixels)


def test_keypoints_of_a_dataset_are_beside_its_frames(tmp_path):
    root = examples_folder() / "data" / "human_walk"
    path = write(tmp_path / "k.csv", "frame,name,x,y,confidence", "1,Nose,10,20,1")
    data = {
        "kind": "depth", "root": str(root), "keypoints": str(path), "frames": 3,
        "keypoint_markers": {"Nose": "head"},
    }  # fmt: skip
    recording = Dataset.parse(data, place="test", field="dataset").only()
    marks = [frame.landmarks for frame in recording.frames()]
    assert [mark is None for mark in marks] == [True, False, True]
    assert marks[1].names == ("head",)
    ((_, again),) = recording.some([1])
    np.testing.assert_array_equal(again.landmarks.pixels, [[10.0, 20.0]])
    assert path in list(recording.input_files())
    assert len(recording.truth().positions) == 3


def test_keypoints_of_several_recordings_need_a_folder(tmp_path):
    root = examples_folder() / "data"
    path = write(tmp_path / "k.csv", "frame,name,x,y,confidence", "0,left_knee,10,20,1")
    data = {"kind": "depth", "root": str(root), "keypoints": str(path), "frames": 1}
    dataset = Dataset.parse(data, place="test", field="dataset")
    with pytest.raises(RegkitError, match=r"there are \d recordings"):
        dataset.chosen()
    name = dataset.model_copy(update={"keypoints": None}).chosen()[0].name
    (tmp_path / "all").mkdir()
    write(tmp_path / "all" / f"{name}.csv", "frame,name,x,y,confidence", "0,left_knee,10,20,1")
    found = dataset.model_copy(update={"keypoints": tmp_path / "all"}).chosen()
    marks = [next(iter(one.frames())).landmarks for one in found]
    assert [mark is not None for mark in marks] == [True] + [False] * (len(marks) - 1)


def test_keypoints_in_the_picture_need_a_camera():
    keypoints = Keypoints.in_picture(("tip",), np.zeros((1, 1, 2)))
    with pytest.raises(RegkitError, match="of one camera"):
        regkit.track([np.zeros((40, 3))], "human", keypoints=keypoints)


def test_keypoints_that_no_marker_follows_are_told(tmp_path):
    path = write(tmp_path / "k.csv", "frame,name,x,y,z,confidence", "0,snout,0.1,0.1,2,1")
    template = regkit.load_template({"kind": "human", "height": 1.63})
    rest = template.body(1.63).skeleton.rest()
    walk = regkit.load_recording(examples_folder() / "data" / "human_walk", frames=1)
    with pytest.warns(regkit.RegkitWarning, match=r"snout.*left_knee.*keypoint_markers"):
        regkit.track(walk, template, start=rest, keypoints=path, segmentation=[])


def test_keypoints_that_the_method_does_not_read_are_told(tmp_path):
    path = write(tmp_path / "k.csv", "frame,name,x,y,z,confidence", "0,left_knee,0.1,0.1,2,1")
    template = regkit.load_template({"kind": "human", "height": 1.63})
    rest = template.body(1.63).skeleton.rest()
    walk = regkit.load_recording(examples_folder() / "data" / "human_walk", frames=1)
    options = {"start": rest, "keypoints": path, "segmentation": []}
    with pytest.warns(regkit.RegkitWarning, match="the method looks at none of them"):
        regkit.track(walk, template, "spheres", **options)
