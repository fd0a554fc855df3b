"""``regkit example``: the examples come with the wheel, and their copies are whole."""

import os
import subprocess
import sys
import zipfile
from pathlib import Path

import pytest
from hatchling.builders.wheel import WheelBuilder
from places import ROOT

from regkit.scaffold.examples import Example, examples

EXPERIMENTS = [one.name for one in examples() if one.file.suffix == ".yaml"]
PLUGINS = [one.name for one in examples() if "--plugin" in one.command]


def test_list_has_a_sentence_for_each_example(regkit):
    told = regkit("example").out
    for one in examples():
        assert f" {one.name} " in told
        assert 20 < len(one.summary) < 200
        assert one.summary.endswith(".")


@pytest.mark.parametrize("name", EXPERIMENTS)
def test_copy_of_an_experiment_is_whole(regkit, tmp_path, name):
    ended = regkit("example", name, "--out", tmp_path)
    assert ended.code == 0
    folder = tmp_path / name
    assert f"cd {folder}" in ended.out
    assert Example.named(name).command in ended.out
    assert regkit("validate", folder / f"{name}.yaml").code == 0
    for path in Example.named(name).data:
        assert (folder / path).exists()


@pytest.mark.parametrize("name", PLUGINS)
def test_command_for_the_copy_of_a_plugin_runs(regkit, tmp_path, monkeypatch, name):
    assert regkit("example", name, "--out", tmp_path).code == 0
    monkeypatch.chdir(tmp_path / name)
    assert regkit(*Example.named(name).command.split()[1:]).code == 0


def test_example_overwrites_nothing(regkit, tmp_path):
    (tmp_path / "demo").mkdir()
    ended = regkit("example", "demo", "--out", tmp_path)
    assert ended.code == 1
    assert f"{tmp_path / 'demo'}: the folder exists already" in ended.err
    assert [path.name for path in tmp_path.rglob("*")] == ["demo"]


def test_unknown_example_is_told_with_those_that_are(regkit, tmp_path):
    ended = regkit("example", "dmeo", "--out", tmp_path)
    assert ended.code == 1
    assert "did you mean 'demo'?" in ended.err
    assert list(tmp_path.iterdir()) == []


def test_wheel_carries_the_examples_and_stays_small(tmp_path):
    (wheel,) = map(Path, WheelBuilder(str(ROOT)).build(directory=str(tmp_path)))
    assert wheel.stat().st_size < 4.5e6
    installed, empty = tmp_path / "installed", tmp_path / "empty"
    zipfile.ZipFile(wheel).extractall(installed)
    empty.mkdir()
    ended = subprocess.run(
        [sys.executable, "-m", "regkit", "example", "hand"],
        env={**os.environ, "PYTHONPATH": str(installed), "PYTHONDONTWRITEBYTECODE": "1"},
        cwd=empty, capture_output=True, text=True, check=False,
    )  # fmt: skip
    assert ended.returncode == 0, ended.stderr
    shipped, source = empty / "hand", ROOT / "docs" / "examples"
    data = sorted(path.relative_to(shipped) for path in (shipped / "data").rglob("*.png"))
    assert [source / path for path in data] == sorted(
        (source / "data/hand_gestures").rglob("*.png")
    )
    assert not (installed / "docs").exists()
