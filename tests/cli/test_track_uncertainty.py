"""``regkit track`` tells how sure its poses are, and smooths them."""

import csv
import json

import numpy as np
import pytest
from walk import FEW, HUMAN, START, WALK, arrays


@pytest.fixture(autouse=True)
def elsewhere(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    return tmp_path


def told_deviations(folder):
    """The markers' standard deviations of a track's file, by frame and marker."""
    with (folder / "deviations.csv").open() as stream:
        return {
            (int(row["frame"]), row["joint"]): [float(row[axis]) for axis in "xyz"]
            for row in csv.DictReader(stream)
        }


def test_streams_of_poses_have_the_deviations_of_the_tracks_own_file(regkit, tmp_path):
    ended = regkit("track", WALK, *HUMAN, *START, *FEW, "--out", "-")
    assert ended.code == 0, ended.err
    known = told_deviations(tmp_path / "tracks" / "human_walk")
    for pose in map(json.loads, ended.out.splitlines()):
        for marker, deviations in pose["deviations"].items():
            np.testing.assert_allclose(deviations, known[pose["frame"], marker], atol=2e-6)
    ended = regkit("track", WALK, *HUMAN, *START, *FEW, "--out", "poses.csv")
    assert ended.code == 0, ended.err
    with (tmp_path / "poses.csv").open() as stream:
        row = list(csv.DictReader(stream))[2]
    found = [float(row[f"left_wrist_sigma_{axis}"]) for axis in "xyz"]
    np.testing.assert_allclose(found, known[2, "left_wrist"], atol=2e-6)


UNKNOWN = (
    "{kind: direct, shape: gsog, kernel: local_likelihood, solver: gauss_newton, "
    "tracker: constant_pose}"
)
"""A method whose kernel knows no residuals, so that nothing is known of its uncertainty."""


def test_streams_of_a_method_without_a_covariance_have_no_deviations(regkit, tmp_path):
    few = ("--frames", 1, "--method", UNKNOWN)
    ended = regkit("track", WALK, *HUMAN, *START, *few, "--out", "-")
    assert ended.code == 0, ended.err
    assert json.loads(ended.out)["deviations"] is None
    ended = regkit("track", WALK, *HUMAN, *START, *few, "--out", "poses.csv")
    assert ended.code == 0, ended.err
    with (tmp_path / "poses.csv").open() as stream:
        (row,) = csv.DictReader(stream)
    assert row["left_wrist_sigma_x"] == ""


def test_smoothed_track_has_less_jitter_and_its_uncertainty(regkit, tmp_path):
    frames = ("--frames", 12)
    for smooth in (["--out", "plain"], ["--smooth", "--out", "smooth"]):
        ended = regkit("track", WALK, *HUMAN, *START, *frames, "--method", "filtered", *smooth)
        assert ended.code == 0, ended.err
    told = [
        json.loads((tmp_path / name / "result.json").read_text()) for name in ("plain", "smooth")
    ]
    assert [one["smoothed"] for one in told] == [False, True]
    plain, smooth = arrays(tmp_path / "plain"), arrays(tmp_path / "smooth")
    assert np.abs(plain["markers"] - smooth["markers"]).max() < 0.1
    jitter = [np.abs(np.diff(one["markers"], n=2, axis=0)).mean() for one in (plain, smooth)]
    assert jitter[1] < 0.6 * jitter[0]
    np.testing.assert_array_equal(plain["verdicts"], smooth["verdicts"])
    with (tmp_path / "smooth" / "deviations.csv").open() as stream:
        rows = list(csv.DictReader(stream))
    assert len(rows) == 12 * len(smooth["marker_names"])
    assert all(0.0 < float(row[axis]) < 1.0 for row in rows for axis in "xyz")
    assert smooth["covariances"].shape == plain["covariances"].shape


def test_motion_that_cannot_be_smoothed_is_kept_and_told(regkit, tmp_path):
    given = (*HUMAN, *START, "--frames", 2, "--method", UNKNOWN, "--smooth", "--out", "out")
    ended = regkit("track", WALK, *given)
    assert ended.code == 1
    assert "--smooth" in ended.err
    assert "cannot be smoothed" in ended.err
    assert len(arrays(tmp_path / "out")["root"]) == 2
    streamed = regkit("track", WALK, *HUMAN, *START, "--smooth", "--out", "-")
    assert streamed.code == 1
    assert "cannot be smoothed" in streamed.err
