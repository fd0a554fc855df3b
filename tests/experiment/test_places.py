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
