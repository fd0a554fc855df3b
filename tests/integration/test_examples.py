"""The examples run, and track what they show."""

import json

import pytest
from places import EXAMPLES
from small_experiment import FRAMES

SOME = {"paper": "[02_walk]", "paper_why": "[05_bow]"}
"""One of their 28 recordings for each, of two of the three people."""


SHORT = ("rigid", "robot", "calibrate", "hand_with_object", "two_hands", "body_with_hands")
"""Examples that `make test` tries here; blocks of README.md and docs/index.md run three more."""


@pytest.mark.parametrize(
    "path",
    [
        pytest.param(path, id=path.stem, marks=[] if path.stem in SHORT else [pytest.mark.long])
        for path in sorted(EXAMPLES.glob("*.yaml"))
    ],
)
def test_example_runs_on_two_frames(regkit, tmp_path, request, path):
    """Every one whose data are shipped, or are among the reference data."""
    settings = ["--set", f"dataset.frames={FRAMES}"]
    if path.stem == "utd":
        data = request.getfixturevalue("reference_data") / "utd_mhad"
        settings += ["--set", f"dataset.root={data}", "--set", "dataset.recordings=[a1_s1_t1]"]
    if path.stem in SOME:
        settings += ["--set", f"dataset.recordings={SOME[path.stem]}"]
    ended = regkit("run", path, "--out", tmp_path / "out", "--no-figures", *settings)
    assert ended.code == 0, ended.err
    # The paper's bare energies are doubtful on some, and that is told.
    assert all(line.startswith("warning: ") for line in ended.err.splitlines())
    methods = json.loads((tmp_path / "out" / "metrics.json").read_text())["methods"]
    for figures in methods.values():
        assert figures["mean"]["frames"] == FRAMES
        assert 0.0 < figures["mean"]["joint_error_raw_cm"] < 25.0


@pytest.mark.long
def test_spheres_track_the_shipped_walk_to_a_centimetre(regkit, tmp_path):
    """From the start that is found, in noise of 8 mm."""
    example, out = EXAMPLES / "spheres.yaml", tmp_path / "out"
    few = ("--set", "dataset.frames=5", "--only", "spheres", "--no-figures")
    assert regkit("run", example, "--out", out, *few).code == 0
    figures = json.loads((out / "metrics.json").read_text())["methods"]["spheres"]["mean"]
    assert figures["joint_error_raw_cm"] < 1.0
    assert figures["lost_frames"] == 0


@pytest.mark.long
def test_preset_icp_follows_the_shipped_walk(regkit, tmp_path):
    """The mesh is the person's own, and the start is found."""
    out = tmp_path / "out"
    settings = ("methods={icp: {preset: icp}}", "dataset.frames=3")
    options = ["--no-figures"]
    options += [option for setting in settings for option in ("--set", setting)]
    ended = regkit("run", EXAMPLES / "demo.yaml", "--out", out, *options)
    assert ended.code == 0, ended.err
    measure = json.loads((out / "icp" / "human_walk" / "measure.json").read_text())
    assert measure["joint_error_raw_cm"] < 2.0
    assert (out / "icp" / "human_walk" / "overlay.png").is_file()
