"""``regkit report`` makes the report from what a run left behind."""

import base64
import gzip
import json
import re
import shutil
from pathlib import Path

import pytest
from small_experiment import add_method, damage, small

from regkit.experiment import Experiment, found, report, run
from regkit.experiment.reporting import run_in
from regkit.experiment.results import Results
from regkit.experiment.scenes import write_replay
from regkit.system.notes import RegkitWarning


@pytest.fixture(scope="module")
def done(tmp_path_factory) -> Path:
    """The results of two methods on two recordings, of which one is damaged."""
    files = small(tmp_path_factory.mktemp("reported"))
    add_method(files.experiment, "sog", "sog")
    damage(files.data / "first" / "depth" / "000001.png")
    run(Experiment.read(files.experiment), files.out)
    return files.out


@pytest.fixture
def results(done, tmp_path) -> Path:
    return Path(shutil.copytree(done, tmp_path / "results"))


def test_report_is_written_anew_from_the_files_of_the_recordings(regkit, results):
    page = (results / "report.html").read_text()
    metrics = json.loads((results / "metrics.json").read_text())
    for name in ("figures", "tables"):
        shutil.rmtree(results / name)
    for path in (results / "report.html", results / "report.md",
                 results / "sog" / "second" / "overlay.png"):  # fmt: skip
        path.unlink()
    ended = regkit("report", results)
    assert ended.code == 0, ended.err
    assert f"report: {results / 'report.html'}" in ended.out
    again = (results / "report.html").read_text()
    assert again.count("<figure") == page.count("<figure")
    assert again.count("data-key") == page.count("data-key")
    assert "000001.png: " in again
    assert (results / "sog" / "second" / "overlay.png").is_file()
    assert (results / "figures" / "over_time.csv").is_file()
    assert json.loads((results / "metrics.json").read_text()) == metrics


def test_report_does_not_need_the_plug_ins_of_the_run(regkit, results):
    config = results / "config.yaml"
    config.write_text(config.read_text().replace("kind: gsog", "kind: no_longer_installed"))
    assert regkit("report", results).code == 0
    assert "no_longer_installed" in (results / "report.html").read_text()


def test_run_that_was_killed_before_its_first_report_has_one(regkit, results):
    for path in (results / "metrics.json", results / "report.html", results / "report.md"):
        path.unlink()
    assert regkit("report", results).code == 0
    methods = json.loads((results / "metrics.json").read_text())["methods"]
    assert {name: list(one["recordings"]) for name, one in methods.items()} == {
        "gsog": ["second"], "sog": ["second"]
    }  # fmt: skip


def test_pair_that_is_asked_for_is_compared_once(regkit, results):
    assert regkit("report", results, "--compare", "sog,gsog").code == 0
    pairs = json.loads((results / "metrics.json").read_text())["pairs"]
    raw = [pair for pair in pairs if pair["metric"] == "joint_error_raw_cm"]
    assert [{pair["method"], pair["other"]} for pair in raw] == [{"sog", "gsog"}]
    assert raw[0]["n"] == 1
    assert raw[0]["p"] is raw[0]["interval"] is None


@pytest.mark.parametrize(
    ("pair", "expected"),
    [
        ("sog,gsg", "no method 'gsg' in the results (there are: gsog, sog); did you mean 'gsog'?"),
        ("sog,sog", "name two different methods, as in A,B"),
        ("sog", "name two different methods, as in A,B"),
    ],
)
def test_pair_that_is_none_is_refused(regkit, results, pair, expected):
    ended = regkit("report", results, "--compare", pair)
    assert (ended.code, ended.err) == (1, f"error: --compare {pair}: {expected}\n")


def test_folder_that_is_no_result_is_refused(regkit, tmp_path):
    ended = regkit("report", tmp_path)
    assert ended.code == 1
    assert ended.err.startswith(f"error: {tmp_path}: this is not a results folder")


def test_damaged_record_is_told(regkit, results):
    damaged = results / "gsog" / "second" / "record.npz"
    damaged.write_bytes(damaged.read_bytes()[:200])
    ended = regkit("report", results)
    assert ended.code == 1
    assert ended.err.startswith(f"error: {damaged}: damaged")
    assert "continue the run" in ended.err


def test_record_of_a_recording_is_small(results):
    for path in results.glob("*/*/record.npz"):
        assert path.stat().st_size < 300_000


def make_older(folder: Path) -> None:
    """Makes a track one of a version that stored no scene."""
    (folder / "scene.npz").unlink()
    manifest = json.loads((folder / "checksums.json").read_text())
    del manifest["files"]["scene.npz"]
    (folder / "checksums.json").write_text(json.dumps(manifest))


def embedded(page: Path) -> dict:
    data = re.search(r'<script id="scene"[^>]*>(.*?)</script>', page.read_text("utf-8"), re.DOTALL)
    return json.loads(gzip.decompress(base64.b64decode(data[1])))


def test_report_leads_to_a_replay_of_the_tracks(done):
    (recording,) = embedded(done / "replay.html")["recordings"]
    assert (recording["name"], recording["frames"]) == ("second", [0, 1])
    assert [one["name"] for one in recording["methods"]] == ["gsog", "sog"]
    assert {one["why"].split(" ")[0] for one in recording["marked"]} == {"worst"}
    assert recording["joints"]["names"]
    assert 'href="replay.html"' in (done / "report.html").read_text()
    assert "(replay.html)" in (done / "report.md").read_text()
    assert (done / "replay.html").stat().st_size < 5_000_000


def test_tracks_of_an_earlier_version_have_a_report_without_them(results):
    make_older(results / "sog" / "second")
    run = run_in(results, *found(results))
    assert write_replay(run, Results(results)) == "replay.html"
    scene = embedded(results / "replay.html")
    assert [one["name"] for one in scene["recordings"][0]["methods"]] == ["gsog"]
    assert "sog on second" in scene["note"]
    make_older(results / "gsog" / "second")
    with pytest.warns(RegkitWarning, match="no replay"):
        assert write_replay(run_in(results, *found(results)), Results(results)) is None
    assert not (results / "replay.html").exists()
    report(results, *found(results), figures=False)
    assert "replay.html" not in (results / "report.html").read_text()


def test_damaged_scene_is_told(regkit, results):
    damaged = results / "gsog" / "second" / "scene.npz"
    damaged.write_bytes(damaged.read_bytes()[:200])
    ended = regkit("report", results)
    assert ended.code == 1
    assert ended.err.startswith(f"error: {damaged}: damaged")
