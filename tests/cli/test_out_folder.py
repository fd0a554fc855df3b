"""``--out`` is never inside the results of another run."""

import pytest
from places import EXAMPLES

WALK = EXAMPLES / "data" / "human_walk"
RUN = ("config.yaml", "environment.json")
TRACK = ("result.json", "poses.npz")


@pytest.fixture(params=[RUN, TRACK], ids=["run", "track"])
def results(request, tmp_path):
    folder = tmp_path / "results"
    folder.mkdir()
    for name in request.param:
        (folder / name).write_text("")
    return folder


@pytest.mark.parametrize(
    "command", [("register", WALK), ("track", WALK), ("run", EXAMPLES / "demo.yaml")]
)
def test_folder_inside_other_results_is_refused(regkit, results, command):
    inside = results / "more" / "deep"
    ended = regkit(*command, "--out", inside)
    assert ended.code == 1
    assert f"--out {inside}" in ended.err
    assert f"inside the results folder {results}" in ended.err
    assert not inside.exists()


@pytest.mark.parametrize("command", [("track", WALK), ("run", EXAMPLES / "demo.yaml")])
def test_default_folder_is_not_inside_other_results_either(regkit, results, monkeypatch, command):
    monkeypatch.chdir(results)
    ended = regkit(*command)
    assert ended.code == 1
    assert f"inside the results folder {results}" in ended.err


def test_results_are_not_written_into_a_recording(regkit, tmp_path):
    (tmp_path / "sequence.yaml").write_text("fps: 30\n")
    ended = regkit("track", WALK, "--out", tmp_path)
    assert ended.code == 1
    assert "recording" in ended.err
    assert [one.name for one in tmp_path.iterdir()] == ["sequence.yaml"]


def test_motion_is_not_written_into_the_results_of_a_run(regkit, tmp_path):
    for name in RUN:
        (tmp_path / name).write_text("")
    ended = regkit("track", WALK, "--out", tmp_path)
    assert ended.code == 1
    assert "results folder of a run" in ended.err
