"""``regkit new``: what it writes can be installed, passes conformance and runs, as it is."""

import os
import subprocess
import sys
from pathlib import Path

import pytest
from places import ROOT

from regkit.cli import new
from regkit.config.document import Document
from regkit.scaffold import KINDS, Scaffold

RUN = tuple(what for what in KINDS if what != "source")
"""Kinds that an experiment uses."""

LONG = ("term", "preprocessor", "tracker", "start", "template")
"""Kinds whose example runs for a release only; each runs the plug-ins of the others."""


@pytest.fixture(scope="module")
def environment(tmp_path_factory) -> dict[str, str]:
    """Variables under which packages installed into a folder are found beside all others."""
    target = tmp_path_factory.mktemp("installed")
    return {**os.environ, "PYTHONPATH": str(target), "PYTHONDONTWRITEBYTECODE": "1"}


@pytest.fixture(scope="module")
def packages(tmp_path_factory, environment) -> dict[str, Path]:
    """A new package of each kind, installed."""
    out = tmp_path_factory.mktemp("new")
    folders = {what: Scaffold.checked(what, f"odd_{what}").write(out) for what in KINDS}
    install = ("-m", "pip", "install", "--quiet", "--no-deps", "--no-build-isolation")
    ended = run(
        environment, *install, "--disable-pip-version-check",
        "--target", environment["PYTHONPATH"], *folders.values(),
    )  # fmt: skip
    assert ended.returncode == 0, ended.stderr
    return folders


def run(environment: dict[str, str], *arguments: object, at: Path = ROOT):
    return subprocess.run(
        [sys.executable, *map(str, arguments)],
        env=environment, cwd=at, capture_output=True, text=True, check=False,
    )  # fmt: skip


def test_new_packages_pass_conformance_as_they_are_written(packages, environment):
    tests = [folder / "tests" for folder in packages.values()]
    ended = run(
        environment, "-m", "pytest", "-q", "-W", "error", "--import-mode=importlib",
        "-p", "no:cacheprovider", "-p", "no:dash", "-c", packages["shape"] / "pyproject.toml",
        *tests,
    )  # fmt: skip
    assert ended.returncode == 0, ended.stdout
    listed = run({**environment, "COLUMNS": "200"}, "-m", "regkit", "plugins").stdout
    for what in KINDS:
        assert f" odd_{what} " in listed


@pytest.fixture
def installed(packages, environment, monkeypatch) -> dict[str, Path]:
    """The new packages, installed for this process too."""
    monkeypatch.syspath_prepend(environment["PYTHONPATH"])
    return packages


@pytest.mark.parametrize("what", RUN)
def test_example_of_a_new_package_is_whole(regkit, installed, what):
    example = installed[what] / "example.yaml"
    assert regkit("validate", example).code == 0
    dataset = Document.read(example).data["dataset"]
    assert (example.parent / dataset["root"]).is_dir()


@pytest.mark.parametrize(
    "what",
    [pytest.param(one, marks=[pytest.mark.long] if one in LONG else []) for one in RUN],
)
def test_example_of_a_new_package_runs(regkit, installed, tmp_path, what):
    example = installed[what] / "example.yaml"
    methods = list(Document.read(example).data["methods"])
    ended = regkit(
        "run", example, "--out", tmp_path, "--set", "dataset.frames=1", "--no-figures",
        "--only", methods[0],
    )  # fmt: skip
    assert ended.code == 0, ended.err


def test_command_line_names_the_kinds_that_there_are():
    assert set(new.KINDS) == set(KINDS)


def test_new_packages_are_written_as_regkit_is(packages, environment):
    folders = packages.values()
    for command in ("check", "format --check"):
        ended = run(
            environment, "-m", "ruff", *command.split(), "--config", ROOT / "pyproject.toml",
            "--no-cache", *folders,
        )  # fmt: skip
        assert ended.returncode == 0, ended.stdout


@pytest.mark.parametrize("what", KINDS)
def test_new_says_what_it_wrote_and_what_comes_next(regkit, tmp_path, what):
    ended = regkit("new", what, "quick_fox", "--out", tmp_path / "here")
    folder = tmp_path / "here" / "regkit-quick-fox"
    assert ended.code == 0
    lines = ended.out.splitlines()
    assert lines[0] == f"written: {folder}"
    assert (folder / "src" / "regkit_quick_fox" / f"{what}.py").is_file()
    assert [line.split()[0] for line in lines[2:]] == ["cd", "pytest", "regkit"]
    files = [path for path in sorted(folder.rglob("*")) if path.is_file()]
    texts = [path.read_text() for path in files if path.suffix != ".png"]
    assert not any("{{" in text or "{%" in text for text in texts)
    assert "quick_fox" in (folder / "pyproject.toml").read_text()


def test_new_shape_is_one_short_file(regkit, tmp_path):
    regkit("new", "shape", "quick_fox", "--out", tmp_path)
    (file,) = (tmp_path / "regkit-quick-fox" / "src" / "regkit_quick_fox").glob("shape.py")
    assert len(file.read_text().splitlines()) < 60


@pytest.mark.parametrize(
    ("arguments", "expected"),
    [
        (("shapes", "fox"), "WHAT: there is no scaffold of a 'shapes'; there are: shape, kernel"),
        (("shape", "Fox"), "NAME: 'Fox' cannot be a plug-in's name: use lower-case letters"),
        (("shape", "quick-fox"), "NAME: 'quick-fox' cannot be a plug-in's name"),
        (("shape", "../fox"), "NAME: '../fox' cannot be a plug-in's name"),
        (("shape", "lambda"), "NAME: 'lambda' cannot be a plug-in's name"),
        (("shape", "gsog"), "NAME: there is a shape 'gsog' already, of regkit 0."),
        (("kernel", "likelihood"), "NAME: there is a kernel 'likelihood' already, of regkit 0."),
    ],
)
def test_new_refuses_what_cannot_be(regkit, tmp_path, arguments, expected):
    ended = regkit("new", *arguments, "--out", tmp_path / "out")
    assert ended.code == 1
    assert ended.err.startswith(f"error: {expected}")
    assert not (tmp_path / "out").exists()


def test_new_writes_over_nothing(regkit, tmp_path):
    (tmp_path / "regkit-fox").mkdir()
    (tmp_path / "regkit-fox" / "mine.txt").write_text("mine")
    ended = regkit("new", "shape", "fox", "--out", tmp_path)
    assert ended.code == 1
    assert f"{tmp_path / 'regkit-fox'}: the folder exists already" in ended.err
    assert [path.name for path in tmp_path.rglob("*")] == ["regkit-fox", "mine.txt"]


def test_new_in_a_folder_that_cannot_be_is_told(regkit, tmp_path):
    (tmp_path / "file").write_text("")
    ended = regkit("new", "shape", "fox", "--out", tmp_path / "file")
    assert ended.code == 1
    assert "cannot be written" in ended.err
