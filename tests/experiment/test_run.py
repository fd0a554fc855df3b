"""What a run writes, and how it is told what to do."""

import json
import re
import sys

import numpy as np
import pytest
from small_experiment import (
    FRAMES,
    QUICK,
    Files,
    add_method,
    small,
)

from regkit.experiment import Experiment, run
from regkit.metrics import METRICS
from regkit_plugins.datasets.depth import DepthFolders

FILES = ("checksums.json", "measure.json", "poses.npz", "record.npz", "scene.npz", "overlay.png")


@pytest.fixture(scope="module")
def done(tmp_path_factory) -> Files:
    """A finished run of two methods, which several tests look at and none changes."""
    files = small(tmp_path_factory.mktemp("done"))
    add_method(files.experiment, "sog", "sog")
    experiment = Experiment.read(files.experiment)
    outcome = run(experiment, files.out)
    assert outcome.failures == {"sog": {}, "gsog": {}}
    return files


def test_run_writes_what_is_documented(done):
    whole = ("config.yaml", "environment.json", "setup.json", "metrics.json", "report.md")
    for name in (*whole, "report.html", "replay.html", "inputs/first.json", "inputs/second.json"):
        assert (done.out / name).is_file()
    expected = {
        f"{method}/{recording}/{name}"
        for method in ("sog", "gsog")
        for recording in ("first", "second")
        for name in FILES
    }
    assert set(done.written()) == expected
    assert not list(done.out.rglob(".*"))
    for name in expected:
        if name.endswith(".png"):
            assert (done.out / name).read_bytes().startswith(b"\x89PNG")


def test_metrics_have_every_figure_of_every_recording_and_the_mean(done):
    names = set(METRICS)
    metrics = done.metrics()
    assert set(metrics) == {"sog", "gsog"}
    for method, figures in metrics.items():
        parts = {"recordings", "mean", "median", "interval", "joints", "parts"}
        assert set(figures) == parts
        assert set(figures["recordings"]) == {"first", "second"}
        for name in names:
            values = [figures["recordings"][s][name] for s in ("first", "second")]
            # Neither was lost, no solver tells how sure it is, and there are no parts.
            absent = ("recovery_s", "marker_deviation_cm", "interval_coverage_percent",
                      "exchanged_percent")  # fmt: skip
            if name in absent and values == [None, None]:
                continue
            assert all(np.isfinite(value) for value in values), name
            assert figures["mean"][name] == pytest.approx(np.mean(values))
        assert set(figures["mean"]) == names
        for recording in ("first", "second"):
            own = json.loads((done.out / method / recording / "measure.json").read_text())
            assert own == figures["recordings"][recording]
        assert figures["mean"]["frames"] == FRAMES
        assert 0.0 < figures["mean"]["joint_error_raw_cm"] < 40.0


def test_poses_are_those_that_the_metrics_tell_of(done):
    """Errors recomputed from the written markers and the truth are the written ones."""
    (first, _) = DepthFolders(root=done.data).chosen()
    truth = first.truth()
    with np.load(done.out / "gsog" / "first" / "poses.npz", allow_pickle=False) as arrays:
        names = [str(name) for name in arrays["marker_names"]]
        assert arrays["root"].shape == (FRAMES, 4, 4)
        assert arrays["balls"].shape == (FRAMES, len(arrays["ball_names"]), 4)
        assert len(arrays["hinges"]) == FRAMES
        assert float(arrays["size"]) == 1.7
        np.testing.assert_allclose(np.linalg.norm(arrays["balls"], axis=2), 1.0)
        columns = [names.index(joint) for joint in truth.joints if joint in names]
        known = [index for index, joint in enumerate(truth.joints) if joint in names]
        distances = np.linalg.norm(
            arrays["markers"][:, columns] - truth.positions[:, known], axis=2
        )
    figures = done.metrics()["gsog"]["recordings"]["first"]
    assert len(columns) >= 15
    assert 100.0 * distances.mean() == pytest.approx(figures["joint_error_raw_cm"])
    assert 100.0 * (distances < 0.1).mean() == pytest.approx(figures["within_10cm_percent"])


def test_environment_names_versions_and_machine(done):
    environment = json.loads((done.out / "environment.json").read_text())
    assert environment["python"] == ".".join(map(str, sys.version_info[:3]))
    assert environment["libraries"]["numpy"] == np.__version__
    assert {"regkit", "system", "processor", "cores"} <= set(environment)


def test_report_shows_every_method_and_links_to_its_pictures(done):
    text = (done.out / "report.md").read_text()
    links = re.findall(r"!\[[^\]]*\]\(([^)]+)\)", text)
    assert {link for link in links if link.endswith("overlay.png")} == {
        f"{method}/{recording}/overlay.png"
        for method in ("sog", "gsog")
        for recording in ("first", "second")
    }
    assert all((done.out / link).is_file() for link in links)
    assert "## Failed" not in text
    raw = done.metrics()["gsog"]["mean"]["joint_error_raw_cm"]
    assert re.search(rf"\| gsog \| 2 \| (\*\*)?{raw:.2f}", text)


def test_config_holds_every_default_and_runs_again(regkit, done, tmp_path):
    """The written configuration is itself an experiment, with the same outcome."""
    config = done.out / "config.yaml"
    assert "gradient_tolerance: 0.0001" in config.read_text()
    ended = regkit("run", config, "--out", tmp_path / "out", "--no-figures", "--only", "gsog")
    assert ended.code == 0
    assert "failed" not in ended.err
    assert "gsog" in ended.out
    assert f"results: {tmp_path / 'out'}" in ended.out
    again = done._replace(out=tmp_path / "out")
    assert config.read_text() == (again.out / "config.yaml").read_text()
    figures = done.metrics()["gsog"]["mean"]
    for name in ("joint_error_raw_cm", "surface_distance_mm", "evaluations_per_frame"):
        assert again.metrics()["gsog"]["mean"][name] == figures[name]


def test_resolved_configuration_can_be_run_again(regkit, files, tmp_path):
    assert regkit("run", files.experiment, "--out", files.out, *QUICK).code == 0
    again = tmp_path / "again"
    assert regkit("run", files.out / "config.yaml", "--out", again, "--no-figures").code == 0
    assert (again / "config.yaml").read_text() == (files.out / "config.yaml").read_text()


def test_figures_are_null_without_truth(regkit, files):
    for path in files.data.glob("*/truth.csv"):
        path.unlink()
    assert regkit("run", files.experiment, "--out", files.out, "--no-figures").code == 0
    figures = files.metrics()["gsog"]
    for row in (figures["mean"], figures["recordings"]["first"]):
        for name in (
            "joint_error_raw_cm",
            "joint_error_adjusted_cm",
            "within_10cm_percent",
            "within_10cm_adjusted_percent",
            "lost_frames",
        ):
            assert row[name] is None
        assert row["surface_distance_mm"] > 0.0
        assert row["fps"] > 0.0


def test_recording_of_one_frame_is_run(regkit, files):
    ended = regkit(
        "run", files.experiment, "--out", files.out, "--no-figures", "--set", "dataset.frames=1"
    )
    assert ended.code == 0
    figures = files.metrics()["gsog"]["recordings"]["second"]
    assert figures["frames"] == 1
    assert figures["joint_error_adjusted_cm"] is None
    assert figures["joint_error_raw_cm"] > 0.0


def test_results_go_to_a_folder_of_their_own_without_out(regkit, files, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    assert regkit("run", files.experiment, *QUICK).code == 0
    (folder,) = (tmp_path / "results" / "small").iterdir()
    assert (folder / "metrics.json").is_file()


def test_empty_folder_is_used(regkit, files):
    files.out.mkdir()
    assert regkit("run", files.experiment, "--out", files.out, *QUICK).code == 0


def test_only_runs_the_named_methods(regkit, files):
    add_method(files.experiment, "sog", "sog")
    assert regkit("run", files.experiment, "--out", files.out, "--only", "gsog", *QUICK).code == 0
    assert {name.split("/")[0] for name in files.written()} == {"gsog"}
    assert set(files.metrics()) == {"gsog"}


def test_setting_changes_the_run(regkit, files):
    def evaluations(out: str, *settings: str) -> float:
        folder = files.out / out
        options = [part for setting in settings for part in ("--set", setting)]
        arguments = ("run", files.experiment, "--out", folder, *QUICK, *options)
        assert regkit(*arguments).code == 0
        metrics = json.loads((folder / "metrics.json").read_text())
        return metrics["methods"]["gsog"]["mean"]["evaluations_per_frame"]

    few = evaluations("few", "methods.gsog.solver.max_iterations=1")
    assert few < evaluations("more")
    assert "max_iterations: 1\n" in (files.out / "few" / "config.yaml").read_text()


def test_table_names_the_units(regkit, files):
    ended = regkit("run", files.experiment, "--out", files.out, *QUICK)
    for unit in ("raw [cm]", "PCK [%]", "surf.", "[mm]", "found"):
        assert unit in ended.out


def test_recordings_without_reference_are_not_compared(regkit, files):
    ended = regkit("run", files.experiment, "--out", files.out, *QUICK, "--set",
                   "dataset.compared=false")  # fmt: skip
    assert ended.code == 0
    assert files.metrics()["gsog"]["mean"]["joint_error_raw_cm"] is None
