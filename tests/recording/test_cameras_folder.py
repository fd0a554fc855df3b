"""Recordings of several cameras in the folder format."""

import json
import shutil

import numpy as np
import pytest
from PIL import Image

from regkit.geometry.camera import Camera
from regkit.geometry.rigid import exp, transformed
from regkit.interfaces import Dataset
from regkit.recording import Cameras
from regkit.recording.instants import matched
from regkit.system.errors import RegkitError
from regkit.system.notes import RegkitWarning

CAMERA = Camera(16, 12, 20.0, 20.0, 7.5, 5.5)
BESIDE = exp(np.array([1.0, 0.2, 0.5, 0.1, -0.8, 0.2]))


def camera_folder(folder, count=4, times=None, *, intrinsics=True):
    """A camera's folder, whose frame k is a wall at 1 + k / 10 m."""
    (folder / "depth").mkdir(parents=True)
    for frame in range(count):
        image = np.full((12, 16), 1000 + 100 * frame, np.uint16)
        Image.fromarray(image).save(folder / "depth" / f"{frame:06d}.png")
    (folder / "sequence.yaml").write_text("fps: 10\n")
    if intrinsics:
        (folder / "camera.json").write_text(CAMERA.to_json())
    if times is not None:
        rows = "".join(f"{frame},{time}\n" for frame, time in enumerate(times))
        (folder / "times.csv").write_text("frame,time_s\n" + rows)


def recording(tmp_path, **cameras):
    """The recording of two cameras, of which the second stands beside the first."""
    described = {
        "left": {"T_world_camera": np.eye(4).tolist()},
        "right": {"T_world_camera": BESIDE.tolist()},
    }
    for name, more in cameras.items():
        described[name] = {**described[name], **more}
    (tmp_path / "cameras.json").write_text(json.dumps({"cameras": described}, indent=1))
    return tmp_path


def read(folder, **fields):
    data = Dataset.at(folder, **fields)
    return Dataset.parse(data, place="test", field="dataset").only()


def test_frame_of_two_cameras_has_both_views_in_the_world(tmp_path):
    camera_folder(tmp_path / "left")
    camera_folder(tmp_path / "right")
    found = read(recording(tmp_path))
    assert found.length == 4
    assert found.fps == 10.0
    frame = next(iter(found.frames()))
    left, right = frame.views
    assert (left.name, right.name) == ("left", "right")
    np.testing.assert_array_equal(frame.points[: 16 * 12], left.data.points)
    np.testing.assert_allclose(frame.points[16 * 12 :], transformed(BESIDE, right.data.points))
    assert frame.camera is None
    assert frame.depth is None
    alone = list(read(tmp_path / "left").frames())
    np.testing.assert_array_equal(alone[0].points, left.data.points)
    np.testing.assert_array_equal(alone[2].depth, list(found.frames())[2].views[0].data.depth)


def test_frames_are_matched_to_the_nearest_in_time(tmp_path):
    camera_folder(tmp_path / "left", times=[0.0, 0.1, 0.2, 0.3])
    camera_folder(tmp_path / "right", times=[0.07, 0.17, 0.27, 0.37])
    found = read(recording(tmp_path))
    depths = [[view.data.points[0, 2] for view in frame.views] for frame in found.frames()]
    np.testing.assert_allclose(depths[0], [1.0])
    np.testing.assert_allclose(depths[1:4], [[1.1, 1.0], [1.2, 1.1], [1.3, 1.2]])
    np.testing.assert_allclose(depths[4], [1.3])
    with pytest.warns(RegkitWarning) as told:
        found.prepare()
    assert any("'right' has no frame in 1 of 5 instants, 0" in str(one.message) for one in told)


def test_offset_of_a_clock_is_added(tmp_path):
    camera_folder(tmp_path / "left", times=[0.0, 0.1, 0.2, 0.3])
    camera_folder(tmp_path / "right", times=[100.0, 100.1, 100.2, 100.3])
    found = read(recording(tmp_path, right={"time_offset_s": -100.1}))
    depths = [[view.data.points[0, 2] for view in frame.views] for frame in found.frames()]
    np.testing.assert_allclose(depths[0], [1.0])
    np.testing.assert_allclose(depths[1], [1.0, 1.1])


def test_stopped_camera_is_absent_and_told(tmp_path):
    camera_folder(tmp_path / "left")
    camera_folder(tmp_path / "right", count=2)
    found = read(recording(tmp_path))
    assert [len(frame.views) for frame in found.frames()] == [2, 2, 1, 1]
    with pytest.warns(RegkitWarning, match="'right' has no frame in 2 of 4 instants, 2 to 3"):
        found.prepare()


@pytest.mark.parametrize("way", ["path", "content"])
def test_intrinsics_may_stand_elsewhere(way, tmp_path):
    camera_folder(tmp_path / "left")
    camera_folder(tmp_path / "right", intrinsics=False)
    (tmp_path / "lens.json").write_text(CAMERA.to_json())
    given = "lens.json" if way == "path" else json.loads(CAMERA.to_json())
    found = read(recording(tmp_path, right={"intrinsics": given}))
    assert next(iter(found.frames())).views[1].data.camera == CAMERA
    assert next(iter(found.cameras()["right"].frames())).camera == CAMERA
    assert (tmp_path / "cameras.json") in found.input_files()


def test_cameras_may_record_clouds_and_share_a_description(tmp_path):
    camera_folder(tmp_path / "left")
    (tmp_path / "left" / "sequence.yaml").rename(tmp_path / "sequence.yaml")
    clouds = tmp_path / "scans" / "clouds"
    clouds.mkdir(parents=True)
    for frame in range(4):
        np.savez(clouds / f"{frame:06d}.npz", points=np.eye(3) + frame)
    found = read(recording(tmp_path, right={"folder": "scans"}))
    views = list(found.frames())[1].views
    assert views[0].data.depth is not None
    np.testing.assert_array_equal(views[1].data.points, np.eye(3) + 1)


def test_folder_of_recordings_holds_those_of_several_cameras(tmp_path):
    for name in ("left", "right"):
        camera_folder(tmp_path / "both" / name)
    camera_folder(tmp_path / "alone")
    recording(tmp_path / "both")
    data = {"kind": "depth", "root": str(tmp_path)}
    found = Dataset.parse(data, place="test", field="dataset").found()
    assert [(one.name, bool(one.cameras())) for one in found] == [("alone", False), ("both", True)]


@pytest.mark.parametrize(
    ("change", "words"),
    [
        ({"T_world_camera": np.diag([1.0, 1.0, -1.0, 1.0]).tolist()}, ["reflects", "right"]),
        ({"T_world_camera": None}, ["calibrate --extrinsics", "right"]),
        ({"T_word_camera": 1}, ["T_world_camera", "right", "cameras.json:"]),
        ({"folder": "nowhere"}, ["nowhere", "depth/"]),
        ({"intrinsics": {"width": 16}}, ["height", "cameras.json"]),
        ({"intrinsics": "nothing.json"}, ["nothing.json"]),
    ],
)
def test_wrong_camera_is_refused_by_name(change, words, tmp_path):
    camera_folder(tmp_path / "left")
    camera_folder(tmp_path / "right")
    folder = recording(tmp_path, right=change)
    with pytest.raises(RegkitError) as refused:
        list(read(folder).frames())
    assert all(word in str(refused.value) for word in words)


def test_times_that_go_back_are_refused(tmp_path):
    camera_folder(tmp_path / "left")
    camera_folder(tmp_path / "right", times=[0.0, 0.2, 0.1, 0.3])
    with pytest.raises(RegkitError, match="frame 2 is not after"):
        read(recording(tmp_path))


def test_clouds_dataset_names_the_kind_of_several_cameras(tmp_path):
    camera_folder(tmp_path / "left")
    shutil.copytree(tmp_path / "left", tmp_path / "right")
    data = {"kind": "clouds", "root": str(recording(tmp_path))}
    with pytest.raises(RegkitError, match="'depth'"):
        Dataset.parse(data, place="test", field="dataset").found()


def test_written_poses_are_read_back(tmp_path):
    folder = recording(tmp_path)
    moved = exp(np.array([0.1, 0.2, 0.3, 0.4, 0.5, 0.6]))
    Cameras.read(folder).placed({"right": moved}, {"right": 0.05}).write(folder)
    again = Cameras.read(folder).cameras["right"]
    np.testing.assert_allclose(again.pose, moved, atol=1e-14)
    assert again.time_offset_s == 0.05


def test_matching_keeps_every_frame_once():
    random = np.random.default_rng(2)
    times = [np.sort(random.uniform(0.0, 3.0, size=count)) for count in (40, 30, 20)]
    instants = matched(times, 0.04)
    for view, own in enumerate(times):
        frames = instants[:, view][instants[:, view] >= 0]
        np.testing.assert_array_equal(frames, np.arange(len(own)))
    for row in instants:
        moments = [times[view][at] for view, at in enumerate(row) if at >= 0]
        assert max(moments) - min(moments) <= 0.04 + 1e-9
