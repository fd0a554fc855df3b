"""What is found wrong once a run begins is told with the line or the setting that says it."""

from __future__ import annotations

import pytest

ELSEWHERE = "subjects:\n  nobody: {kind: human, height: 1.8}\n"


@pytest.mark.parametrize(
    ("old", "new", "settings", "place", "word"),
    [
        ("root: data", "root: nothing", (), "FILE:2: dataset.root: FOLDER/nothing", "folder"),
        ("", "", ("dataset.root=nothing",), "--set dataset.root=nothing: dataset.root", "folder"),
        ("name: small", f"name: small\n{ELSEWHERE}", (), "FILE:3: subjects.nobody", "'nobody'"),
        ("", "", ("dataset.recordings=[x]",),
         "--set dataset.recordings=[x]: dataset.recordings", "'x'"),
        ("root: data", "root: data, recordings: [x]", (), "FILE:2: dataset.recordings", "'x'"),
    ],
)  # fmt: skip
def test_error_of_the_data_names_the_line_or_the_setting(
    regkit, files, monkeypatch, old, new, settings, place, word
):
    monkeypatch.chdir(files.experiment.parent)
    files.experiment.write_text(files.experiment.read_text().replace(old, new, 1))
    options = [part for setting in settings for part in ("--set", setting)]
    ended = regkit("run", files.experiment, "--out", files.out, *options)
    told = ended.err.replace(str(files.experiment), "FILE")
    told = told.replace(str(files.experiment.parent), "FOLDER")
    assert ended.code == 1
    assert told.startswith(f"error: {place}: "), told
    assert word in told
    assert not files.out.exists()


@pytest.mark.parametrize("command", ["register", "calibrate", "report", "export"])
def test_missing_file_of_a_command_is_told_with_what_is_right(regkit, tmp_path, command):
    more = ("--to", tmp_path / "a.bvh") if command == "export" else ()
    ended = regkit(command, tmp_path / "nothing", *more)
    assert ended.code == 1
    assert ended.err.startswith(f"error: {tmp_path / 'nothing'}: there is no such")
    assert any(word in ended.err for word in ("name", "give"))


def test_usage_of_register_has_no_hidden_argument(regkit):
    assert "target" not in regkit("register", "--help").out


JOINTS = """name: joints
dataset: {kind: depth, root: .}
template: {kind: human, height: 1.7}
"""


@pytest.mark.parametrize(
    ("text", "place", "word"),
    [
        ("methods:\n  one:\n    preset: filtered\n"
         "    tracker: {kind: filter, joints_deg: {left_forarm: 8}}\n",
         "FILE:7: methods.one.tracker.joints_deg.left_forarm", "did you mean 'left_forearm'"),
        ("methods:\n  one:\n    preset: best\n    terms:\n      - visibility\n"
         "      - {kind: continuity, joints_deg: {left_forarm: 8}}\n",
         "FILE:9: methods.one.terms[1].joints_deg.left_forarm", "did you mean 'left_forearm'"),
        ("methods: {one: {preset: best}}\ntracker: {kind: filter, joints_deg: {nobody: 8}}\n",
         "FILE:5: tracker.joints_deg.nobody", "no segment 'nobody'"),
        ("methods: {one: {preset: best}}\nstart:\n  kind: given\n  joints:\n    left_hip: 8\n",
         "FILE:8: start.joints.left_hip", "no segment 'left_hip'"),
        ("methods: {one: {preset: best}}\nstart: {kind: given, joints: {left_forearm: [8, 3]}}\n",
         "FILE:5: start.joints.left_forearm", "its joint has 1"),
    ],
)  # fmt: skip
def test_joint_that_the_template_lacks_is_found_before_a_run(regkit, tmp_path, text, place, word):
    file = tmp_path / "joints.yaml"
    file.write_text(JOINTS + text)
    ended = regkit("validate", file)
    told = ended.err.replace(str(file), "FILE")
    assert ended.code == 1
    assert told.startswith(f"error: {place}: "), told
    assert word in told


def test_preset_written_as_a_plugin_is_told_how_to_write_it(regkit, tmp_path):
    file = tmp_path / "preset.yaml"
    file.write_text(JOINTS + "methods: {one: best}\n")
    assert "{preset: best}" in regkit("validate", file).err


def test_name_that_no_plugin_has_is_told_where_to_look(regkit):
    assert "did you mean 'robots'" in regkit("plugins", "robts").err
    assert "regkit plugins" in regkit("plugins", "nosuch").err
