"""``regkit track`` of streams: poses as they come, Ctrl-C, a kill, recordings, and exports."""

import csv
import json
import os
import shutil
import signal
import subprocess
import sys
import time

import numpy as np
import pytest
from walk import FEW, HUMAN, START, WALK, arrays


@pytest.fixture(autouse=True)
def elsewhere(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    return tmp_path


def test_poses_are_written_as_rows_and_kept_in_a_folder(regkit, tmp_path):
    ended = regkit("track", WALK, *HUMAN, *START, *FEW, "--out", "poses.csv")
    assert ended.code == 0, ended.err
    with (tmp_path / "poses.csv").open() as stream:
        rows = list(csv.DictReader(stream))
    stored = arrays(tmp_path / "tracks" / "human_walk")
    assert [row["frame"] for row in rows] == ["0", "1", "2", "3"]
    assert {row["verdict"] for row in rows} == {"found"}
    np.testing.assert_allclose(
        [float(rows[2][f"left_wrist_{axis}"]) for axis in "xyz"],
        stored["markers"][2][list(stored["marker_names"]).index("left_wrist")],
        atol=1e-6,
    )
    np.testing.assert_allclose(float(rows[3]["root_z"]), stored["root"][3, 2, 3], atol=1e-6)


def test_poses_are_printed_as_json_lines(regkit, tmp_path):
    ended = regkit("track", WALK, *HUMAN, *START, *FEW, "--out", "-")
    assert ended.code == 0, ended.err
    poses = [json.loads(line) for line in ended.out.splitlines()]
    assert [pose["frame"] for pose in poses] == [0, 1, 2, 3]
    stored = arrays(tmp_path / "tracks" / "human_walk")
    np.testing.assert_allclose(poses[1]["T_camera_root"], stored["root"][1], atol=1e-6)
    assert set(poses[0]["markers"]) == set(stored["marker_names"])
    assert "1.63 m" in ended.err


def test_played_recording_has_a_latency_and_its_own_times(regkit, tmp_path):
    ended = regkit("track", WALK, *HUMAN, *START, "--frames", 8, "--realtime", "--out", "live")
    assert ended.code == 0, ended.err
    found = json.loads((tmp_path / "live" / "result.json").read_text())
    assert 0.0 < found["latency_ms"]["p50"] <= found["latency_ms"]["p99"]
    assert found["frames"] + found["dropped_frames"] == 8
    stored = arrays(tmp_path / "live")
    np.testing.assert_allclose(stored["times"], stored["numbers"] / 30.0, atol=1e-9)


def test_recorded_frames_are_those_of_the_stream(regkit, tmp_path):
    ended = regkit("track", WALK, *HUMAN, *START, *FEW, "--record", "copy", "--out", "first")
    assert ended.code == 0, ended.err
    assert "recorded: 4 frames, in copy" in ended.err
    assert regkit("track", "copy", *HUMAN, *START, "--out", "second").code == 0
    assert (tmp_path / "first" / "markers.csv").read_text() == (
        tmp_path / "second" / "markers.csv"
    ).read_text()
    again = regkit("track", WALK, *HUMAN, *START, *FEW, "--record", "copy")
    assert again.code == 1
    assert "copy: the folder exists already" in again.err


def test_track_is_exported(regkit, tmp_path):
    assert regkit("track", WALK, *HUMAN, *START, *FEW, "--out", "one").code == 0
    for suffix in ("bvh", "csv", "glb"):
        ended = regkit("export", "one", "--to", f"motion.{suffix}")
        assert ended.code == 0, ended.err
        assert "frames: 4, 30 per second" in ended.out
    (tmp_path / "one" / "track.json").write_text("{}")
    assert "track.json: format: " in regkit("export", "one", "--to", "motion.bvh").err


@pytest.mark.parametrize(
    ("times", "count", "told"),
    [
        ((0.0, 1 / 30, 4 / 30, 5 / 30), 6, "held"),
        ((0.0, 1 / 30, 1e9, 1e9 + 1 / 30), 4, "go back or jump"),
        ((5.0, 5.1, 0.0, 0.1), 4, "go back or jump"),
    ],
)
def test_uneven_times_are_resampled_or_told_in_an_export(regkit, tmp_path, times, count, told):
    gaps = tmp_path / "gaps"
    shutil.copytree(WALK, gaps)
    rows = "".join(f"{frame},{at!r}\n" for frame, at in enumerate(times))
    for path in (gaps / "depth").iterdir():
        if int(path.stem) >= 4:
            path.unlink()
    (gaps / "truth.csv").unlink()
    (gaps / "times.csv").write_text(f"frame,time_s\n{rows}")
    assert regkit("track", gaps, *HUMAN, *START, "--out", "one").code == 0
    ended = regkit("export", "one", "--to", "motion.bvh")
    assert ended.code == 0, ended.err
    assert f"frames: {count}, 30 per second" in ended.out
    assert told in ended.err


def running(*arguments) -> subprocess.Popen:
    """The command in a process of its own, at the pace of the recording."""
    command = [sys.executable, "-m", "regkit", "track", *HUMAN, *START, "--realtime", *arguments]
    return subprocess.Popen(
        [str(one) for one in command], stderr=subprocess.PIPE, text=True,
        env=os.environ | {"PYTHONUNBUFFERED": "1"},
    )  # fmt: skip


def wait_for_rows(path, count: int) -> None:
    deadline = time.monotonic() + 60.0
    while not path.is_file() or path.read_text().count("\n") <= count:
        assert time.monotonic() < deadline, "no poses were written"
        time.sleep(0.05)


def test_interrupted_track_is_kept_whole(regkit, tmp_path):
    process = running(WALK, "--out", "poses.csv")
    wait_for_rows(tmp_path / "poses.csv", 10)
    process.send_signal(signal.SIGINT)
    _, told = process.communicate(timeout=60)
    assert process.returncode == 130, told
    assert "stopping after this frame" in told
    assert "Traceback" not in told
    folder = tmp_path / "tracks" / "human_walk"
    frames = json.loads((folder / "result.json").read_text())["frames"]
    assert 10 <= frames < 60
    assert (tmp_path / "poses.csv").read_text().count("\n") == frames + 1
    assert regkit("export", folder, "--to", "motion.bvh").code == 0
    assert not (folder / "frames.rows").exists()


def test_killed_track_is_exported_as_far_as_it_came(regkit, tmp_path, monkeypatch):
    """Also in the folder of a former track, of which nothing is taken for the new one."""
    assert regkit("track", WALK, *HUMAN, *START, *FEW).code == 0
    process = running(WALK, "--out", "poses.csv")
    wait_for_rows(tmp_path / "poses.csv", 40)
    process.kill()
    process.communicate(timeout=60)
    folder = tmp_path / "tracks" / "human_walk"
    assert {path.name for path in folder.iterdir()} == {"track.json", "frames.rows"}
    shown = regkit("view", folder, "--no-browser")
    assert shown.code == 1
    assert "the track did not end" in shown.err
    ended = regkit("export", folder, "--to", "motion.bvh")
    assert ended.code == 0, ended.err
    assert "the track did not end" in ended.err
    assert "frames: " in ended.out


@pytest.mark.parametrize(
    ("arguments", "complaint"),
    [
        (("camera:0",), "no source has the scheme 'camera:'"),
        (("walk.avi",), "there is no such file"),
        ((WALK, "--out", "-", "--json"), "standard output takes the poses"),
        ((WALK, "--opening", "0"), "opening"),
        ((WALK, "--out", "walk.bvh"), "regkit export"),
        ((WALK, "--set", "source.fps=15"), "source.fps"),
    ],
)
def test_mistake_is_told(regkit, tmp_path, arguments, complaint):
    ended = regkit("track", *arguments)
    assert ended.code in (1, 2)
    assert complaint in ended.err
    assert not list(tmp_path.iterdir())
