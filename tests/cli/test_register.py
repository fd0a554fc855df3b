"""``regkit register`` and ``regkit track``: what they find, print and write, and how they end."""

import csv
import json
import shutil

import numpy as np
import pytest
from places import CASES, DATA

from regkit.clouds import write_cloud

WALK = DATA / "human_walk"
HUMAN = ("--template", "{kind: human, height: 1.63}")
START = (
    "--set",
    "start={kind: given, root: {position: [-0.05, -0.05, 3.25], rotation_deg: [180, 0, 0]}}",
)
TABLES = {"markers.csv", "deviations.csv", "hinges.csv", "frames.csv"}
FILES = {"result.json", "track.json", "poses.npz", "scene.npz", "picture.png", *TABLES}


@pytest.fixture
def out(tmp_path):
    return tmp_path / "out"


def test_frame_of_a_folder_and_its_image_give_the_same_pose(regkit, out):
    found = []
    for file in ((WALK, "--frame", 1), (WALK / "depth" / "000001.png",)):
        ended = regkit("register", *file, *HUMAN, *START, "--json")
        assert ended.code == 0, ended.err
        found.append(json.loads(ended.out))
    speeds = [one.pop("frames_per_second") for one in found]
    assert min(speeds) > 0.0
    assert found[0] == found[1]
    assert found[0]["verdict"] == "found"
    assert found[0]["size"] == 1.63
    assert found[0]["method"] == "best"
    assert set(found[0]["markers"]) == set(found[0]["marker_names"])


@pytest.mark.long
def test_image_beside_its_camera_and_a_cloud_file_are_frames(regkit, tmp_path, out):
    for name in ("depth/000000.png", "camera.json"):
        shutil.copy(WALK / name, tmp_path)
    image = regkit("register", tmp_path / "000000.png", *HUMAN, *START, "--json")
    assert image.code == 0, image.err
    half = regkit("register", tmp_path / "000000.png", "--depth-scale", 2000, "--json")
    depths = [json.loads(ended.out)["markers"]["pelvis"][2] for ended in (half, image)]
    assert depths[0] / depths[1] == pytest.approx(0.5, abs=0.1)
    cloud = tmp_path / "cloud.npz"
    write_cloud(cloud, regkit_points())
    ended = regkit("register", cloud, *HUMAN, *START, "--out", out)
    assert ended.code == 0, ended.err
    assert {path.name for path in out.iterdir()} == FILES
    written = json.loads((out / "result.json").read_text())
    image_markers = json.loads(image.out)["markers"]
    gaps = [np.subtract(at, image_markers[name]) for name, at in written["markers"].items()]
    assert np.linalg.norm(gaps, axis=1).mean() < 0.03


def regkit_points():
    import regkit

    return regkit.load_frame(WALK).points


def test_track_writes_the_motion_and_its_summary(regkit, out):
    ended = regkit("track", WALK, *HUMAN, *START, "--frames", 2, "--out", out)
    assert ended.code == 0, ended.err
    for what in ("1.63 m", "surface distance", "inliers", "found in 2 of 2"):
        assert what in ended.out
    assert {path.name for path in out.iterdir()} == FILES
    with np.load(out / "poses.npz") as arrays:
        markers, names = arrays["markers"], list(arrays["marker_names"])
    with (out / "markers.csv").open() as stream:
        rows = list(csv.DictReader(stream))
    assert len(rows) == markers.shape[0] * markers.shape[1] == 2 * len(names)
    with (out / "hinges.csv").open() as stream:
        angles = [float(row["left_shin_rad"]) for row in csv.DictReader(stream)]
    with np.load(out / "poses.npz") as arrays:
        column = list(arrays["hinge_names"]).index("left_shin")
        np.testing.assert_allclose(angles, arrays["hinges"][:, column], atol=1e-6)
    last = rows[-1]
    assert (last["frame"], last["joint"]) == ("1", names[-1])
    position = [float(last[axis]) for axis in "xyz"]
    np.testing.assert_allclose(position, markers[-1, -1], atol=1e-6)


def test_body_that_is_not_there_counts_as_lost(regkit, out):
    hand = DATA / "hand_gestures"
    ended = regkit("track", hand, *HUMAN, "--frames", 1, "--out", out)
    assert ended.code == 3
    assert "error: lost" in ended.err
    assert json.loads((out / "result.json").read_text())["verdict"] == "lost"


@pytest.mark.parametrize("name", ["walk_half_scale", "by_rows_flat"])
def test_data_of_half_the_size_and_a_flat_wall_are_not_found(regkit, name):
    ended = regkit("register", CASES / "11-intrinsics" / name, "--json", "--strict")
    assert ended.code == 3, ended.err
    assert json.loads(ended.out)["verdict"] != "found"
    told = "spread over" if name == "walk_half_scale" else "flat"
    assert told in ended.err


def test_damaged_frame_is_passed_over_and_told(regkit, tmp_path, out):
    shutil.copytree(WALK, tmp_path / "walk")
    depth = tmp_path / "walk" / "depth"
    (depth / "000002.png").write_bytes((depth / "000001.png").read_bytes()[:500])
    ended = regkit("track", tmp_path / "walk", *HUMAN, *START, "--frames", 4, "--out", out)
    assert ended.code == 0
    assert "000002.png" in ended.err
    assert "doubtful: 1 of 4 frames have no data" in ended.err
    with (out / "frames.csv").open() as stream:
        verdicts = [row["verdict"] for row in csv.DictReader(stream)]
    assert verdicts == ["found", "found", "no data", "found"]
    assert json.loads((out / "result.json").read_text())["faults"] == {"damaged": 1}


def test_settings_change_what_options_name(regkit):
    ended = regkit(
        "register", WALK, "--set", "template.height=1.7", "--method", "best",
        "--set", "method.terms=[]", *START, "--json",
    )  # fmt: skip
    assert ended.code == 0, ended.err
    assert json.loads(ended.out)["size"] == 1.7


@pytest.mark.parametrize(
    ("arguments", "complaints"),
    [
        (("register", "a.ply", "b.ply"), ("now called", "align")),
        (("register", "none.ply"), ("none.ply", "no such file")),
        (("register", WALK, "--frame", 999), ("999",)),
        (("register", WALK, "--template", "humn"), ("--template humn", "did you mean 'human'")),
        (("register", WALK, "--method", "bst"), ("--method bst", "did you mean 'best'")),
        (("register", WALK, "--set", "template.heigt=1"), ("template.heigt", "did you mean")),
        (("register", WALK, "--set", "metod=best"), ("--set metod=best", "did you mean 'method'")),
        (("register", WALK, "--set", "start={kind: given}"), ("start", "size")),
        (("track", "nowhere"), ("nowhere", "no such file or folder")),
        (("track", DATA), ("--recording", "name one")),
        (("track", DATA, "--recording", "walk"), ("--recording", "no recording")),
        (("track", WALK, "--tracker", "velocity"), ("--tracker velocity", "did you mean")),
        (("track", WALK, "--out", __file__), (f"--out {__file__}", "file")),
    ],
)
def test_mistake_is_told_at_the_option_and_nothing_is_written(
    regkit, tmp_path, monkeypatch, arguments, complaints
):
    monkeypatch.chdir(tmp_path)
    ended = regkit(*arguments)
    assert ended.code == 1
    assert ended.err.startswith("error: ")
    for complaint in complaints:
        assert complaint in ended.err
    assert not list(tmp_path.iterdir())


def test_image_without_a_camera_is_refused(regkit, tmp_path):
    image = tmp_path / "frame.png"
    shutil.copy(WALK / "depth" / "000000.png", image)
    ended = regkit("register", image)
    assert ended.code == 1
    assert "camera.json" in ended.err


def test_wall_shows_no_body_and_is_no_error_of_the_file(regkit, tmp_path, random):
    file = tmp_path / "wall.xyz"
    across = random.uniform(-1.5, 1.5, size=(4000, 2))
    np.savetxt(file, np.column_stack([across, 2.0 + 0.004 * random.normal(size=4000)]), fmt="%.4f")
    ended = regkit("register", file)
    assert ended.code == 3
    assert "may be the body's" in ended.err
