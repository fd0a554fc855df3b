"""Results folders of another format are refused with the reason, and left as they are."""

import json
import shutil
from pathlib import Path

import pytest
from small_experiment import QUICK, small

from regkit import __version__
from regkit.experiment import Experiment, run
from regkit.experiment.results_format import FORMAT


@pytest.fixture(scope="module")
def done(tmp_path_factory):
    files = small(tmp_path_factory.mktemp("formats"))
    run(
        Experiment.read(files.experiment, [setting for setting in QUICK if "=" in setting]),
        files.out,
    )
    return files


def written_by(done, folder: Path, version: str, number: int | None) -> Path:
    """A copy of the results as if another version had written them."""
    shutil.copytree(done.out, folder)
    file = folder / "environment.json"
    environment = json.loads(file.read_text()) | {"regkit": version, "format": number}
    if number is None:
        del environment["format"]
    file.write_text(json.dumps(environment))
    setup = json.loads((folder / "setup.json").read_text())
    setup["versions"]["regkit"] = version
    (folder / "setup.json").write_text(json.dumps(setup))
    return folder


def commands(done, folder: Path) -> list[tuple[object, ...]]:
    track = next(folder.glob("*/*/poses.npz")).parent
    return [
        ("run", done.experiment, "--out", folder, *QUICK),
        ("report", folder),
        ("export", track, "--to", folder.parent / "motion.csv"),
    ]


def test_results_say_their_format(done):
    environment = json.loads((done.out / "environment.json").read_text())
    assert environment["format"] == FORMAT
    assert environment["regkit"] == __version__


@pytest.mark.parametrize(
    ("version", "number"), [("0.1.0", None), ("9.0.0", FORMAT + 1)], ids=["older", "newer"]
)
@pytest.mark.parametrize("command", range(3), ids=["run", "report", "export"])
def test_results_of_another_format_are_refused(regkit, done, tmp_path, version, number, command):
    folder = written_by(done, tmp_path / "results", version, number)
    before = {path: path.stat().st_mtime_ns for path in folder.rglob("*")}
    ended = regkit(*commands(done, folder)[command])
    assert ended.code == 1
    assert ended.err.startswith(f"error: {folder}: regkit {version} wrote these results")
    for word in (f"format {number or 1};", f"format {FORMAT}.", "Run the experiment again"):
        assert word in ended.err
    assert {path: path.stat().st_mtime_ns for path in folder.rglob("*")} == before


@pytest.mark.long
def test_results_of_another_version_and_the_same_format_are_read_and_not_continued(
    regkit, done, tmp_path
):
    folder = written_by(done, tmp_path / "results", "0.2.9", FORMAT)
    run, *others = commands(done, folder)
    for command in others:
        assert regkit(*command).code == 0
    ended = regkit(*run)
    assert ended.code == 1
    assert f"regkit is 0.2.9 there and {__version__} here" in ended.err


def test_damaged_format_is_told(regkit, done, tmp_path):
    folder = written_by(done, tmp_path / "results", __version__, FORMAT)
    (folder / "environment.json").write_text("{")
    for command in commands(done, folder):
        ended = regkit(*command)
        assert ended.code == 1
        assert ended.err.startswith(f"error: {folder / 'environment.json'}: damaged")
