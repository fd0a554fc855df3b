"""Fixtures that many tests share: a linkage with every type of joint, data, the command line."""

import importlib
import os
import signal
import subprocess
import sys
from collections.abc import Iterator
from pathlib import Path
from typing import NamedTuple

import numpy as np
import pytest
from hypothesis import settings
from places import REFERENCE
from small_experiment import Files, Started, small

from regkit.body import Body, BodyDescription
from regkit.config import registry as registered
from regkit.config.document import Document
from regkit.testing.samples import LINKAGE

# What runs in the background may be started with Ctrl-C ignored, and so would the processes be that
# tests start; they press it as a terminal does.
if signal.getsignal(signal.SIGINT) is signal.SIG_IGN:
    signal.signal(signal.SIGINT, signal.default_int_handler)

settings.register_profile("short", max_examples=30, deadline=None, derandomize=True)
settings.register_profile("long", max_examples=500, deadline=None)
settings.load_profile("short")

# A console keeps the width of the environment in which it is made, and asks each time without one:
# the command line is imported after this.
os.environ.pop("COLUMNS", None)
main = importlib.import_module("regkit.cli").main


@pytest.fixture(scope="session")
def linkage_text() -> str:
    return LINKAGE.read_text()


@pytest.fixture(scope="session")
def linkage() -> Body:
    return Document.read(LINKAGE).validated(BodyDescription).body("linkage", 1.2)


@pytest.fixture
def random() -> np.random.Generator:
    return np.random.default_rng(7)


@pytest.fixture(scope="session")
def reference_data() -> Path:
    """The reference data, which lie beside the project where it is developed."""
    if not REFERENCE.is_dir():
        pytest.skip(f"the reference data are not at {REFERENCE}")
    return REFERENCE


@pytest.fixture(scope="session")
def lump() -> np.ndarray:
    """1,500 points on a closed surface without symmetry, about 0.4 m long, away from the origin."""
    random = np.random.default_rng(3)
    directions = random.normal(size=(1500, 3))
    directions /= np.linalg.norm(directions, axis=1, keepdims=True)
    x, y, z = directions.T
    radii = 1.0 + 0.3 * np.sin(3.0 * x + 1.0) * y + 0.35 * np.cos(2.0 * z) * x + 0.2 * y * z
    return 0.1 * radii[:, None] * directions * [1.6, 1.0, 0.7] + [0.5, -0.2, 1.0]


@pytest.fixture(autouse=True, scope="session")
def own_cache(tmp_path_factory: pytest.TempPathFactory) -> Iterator[None]:
    """No test reads or leaves anything in the user's cache.

    All processes of a test run share one, so that an atlas is made once.
    """
    base = tmp_path_factory.getbasetemp()
    folder = (base.parent if "PYTEST_XDIST_WORKER" in os.environ else base) / "cache"
    folder.mkdir(exist_ok=True)
    with pytest.MonkeyPatch.context() as patch:
        patch.setenv("REGKIT_CACHE", str(folder))
        yield


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
    # However slow the machine is, no line of progress is among what a test compares.
    monkeypatch.setattr("regkit.cli.progress.EVERY", 1e6)
    # Nor is it told that loops are compiled, which depends on what ran before.
    monkeypatch.setattr("regkit.cli.app.when_compiling", lambda _: None)

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
