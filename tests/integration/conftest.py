"""The command line as a fixture."""

import importlib
import subprocess
import sys
from typing import NamedTuple

import pytest
from small_experiment import Files, Started, small

from regkit.cli import main
from regkit.config import registry as registered


class Ended(NamedTuple):
    code: int
    out: str
    err: str


@pytest.fixture(autouse=True)
def registry(monkeypatch):
    """Plug-ins that a test registers are gone after it."""
    monkeypatch.setattr(registered, "_REGISTERED", {})


@pytest.fixture
def regkit(monkeypatch, capsys):
    """The command line in this process; an error that it does not catch fails the test."""
    monkeypatch.setenv("COLUMNS", "200")

    def run(*arguments: object) -> Ended:
        monkeypatch.setattr(sys, "argv", ["regkit", *map(str, arguments)])
        capsys.readouterr()
        with pytest.raises(SystemExit) as caught:
            main()
        told = capsys.readouterr()
        return Ended(int(caught.value.code or 0), told.out, told.err)

    return run


@pytest.fixture
def started():
    """The command line in a process of its own, which is gone when the test ends."""
    processes = []

    def start(*arguments: object) -> Started:
        process = subprocess.Popen(
            [sys.executable, "-m", "regkit", *map(str, arguments)],
            stdout=subprocess.PIPE,
            stderr=subprocess.PIPE,
            text=True,
            start_new_session=True,
        )
        processes.append(process)
        return Started(process)

    yield start
    for process in processes:
        process.kill()
        process.communicate()


@pytest.fixture
def files(tmp_path) -> Files:
    return small(tmp_path)


@pytest.fixture
def distribution(tmp_path, monkeypatch):
    """Install a throw-away distribution with such entry points for the length of a test."""

    def install(entry_points: str, name: str = "broken") -> None:
        folder = tmp_path / name / f"{name}-1.0.dist-info"
        folder.mkdir(parents=True)
        (folder / "METADATA").write_text(f"Metadata-Version: 2.1\nName: {name}\nVersion: 1.0\n")
        (folder / "entry_points.txt").write_text(entry_points)
        monkeypatch.syspath_prepend(str(folder.parent))
        importlib.invalidate_caches()

    return install
