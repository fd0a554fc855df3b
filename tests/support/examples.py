"""Running the code blocks of a page, in a folder that has the project's examples in it."""

from __future__ import annotations

import json
import os
import re
import shlex
import subprocess
import sys
import tomllib
from collections.abc import Callable
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

from pages import Block, Page
from places import ROOT
from ruamel.yaml import YAML

TEMPLATES = ROOT / "plugins" / "regkit_plugins" / "templates"
COMPLETE: dict[str, Any] = {
    "name": "part",
    "dataset": {"kind": "depth", "root": "docs/examples/data/human_walk"},
    "template": "human",
    "preprocessor": {"kind": "points"},
    "methods": {"best": {"preset": "best"}},
}
"""What completes a part of an experiment."""

REQUIRED = {"name", "dataset", "template", "methods"}
"""What has all of these is a whole experiment, which has to be right as it is."""


@dataclass
class Runner:
    """One page's blocks, one after the other.

    Attributes:
        page: The page.
        folder: Where they are run; what one writes, the next ones find.
        command: The command line.
        make_importable: What puts a folder first where this process looks for modules.
        names: What its Python blocks have defined.
        importable: Folders of packages that its commands have installed.
    """

    page: Page
    folder: Path
    command: Callable[..., Any]
    make_importable: Callable[[Path], None]
    names: dict[str, Any] = field(default_factory=lambda: {"__name__": "__main__"})
    importable: list[Path] = field(default_factory=list)

    def prepare(self) -> None:
        """Link the project's files, and what stands for a reader's own."""
        for name in ("docs", "plugins", "benchmarks", "tests"):
            (self.folder / name).symlink_to(ROOT / name)
        for name, target in self.page.stand_ins.items():
            assert (ROOT / target).exists(), f"{self.page.path}: {target} is not there"
            (self.folder / name).parent.mkdir(parents=True, exist_ok=True)
            (self.folder / name).symlink_to(ROOT / target)

    def run(self, block: Block) -> None:
        """Run a block, or check it, by its language."""
        if "file" in block.markers:
            file = Path(block.markers["file"]).absolute()
            file.parent.mkdir(parents=True, exist_ok=True)
            file.write_text(block.text, encoding="utf-8")
        if "from" in block.markers:
            _check_excerpt(block)
            return
        match block.language:
            case "python":
                exec(compile(block.text, block.place, "exec"), self.names)
            case "sh" | "bash" | "console":
                for command, output in _commands(block.text):
                    self._run_command(block, command, output)
            case "yaml":
                self._check_yaml(block)
            case "json":
                json.loads(block.text)
            case "toml":
                tomllib.loads(block.text)
            case language:
                told = "say what language it is; what a program prints is text"
                assert language == "text" or language.startswith("{"), f"{block.place}: {told}"

    def _run_command(self, block: Block, command: str, output: str) -> None:
        words = shlex.split(command, comments=True)
        match words:
            case []:
                return
            case ["cd", folder]:
                os.chdir(folder)
            case ["pip", "install", *_]:
                self._install()
            case ["pytest"]:
                self._run_python("-m", "pytest", "-q", "-p", "no:dash", "-p", "no:cacheprovider")
            case ["make", target]:
                assert f"\n{target}: " in (ROOT / "Makefile").read_text(), command
            case ["python", script, *_] if script.startswith("benchmarks/"):
                assert (ROOT / script).is_file(), command
            case ["regkit", *arguments]:
                if arguments[0] == "run":
                    # The figures of a report are drawn by tests of their own.
                    arguments += ["--no-figures", *shlex.split(block.markers.get("with", ""))]
                if arguments[0] == "calibrate" and "--frames" not in arguments:
                    arguments += ["--frames", "1"]
                if arguments[0] == "track" and "--frames" not in arguments:
                    arguments += ["--frames", "1"]
                ended = self.command(*arguments)
                told = f"{block.place}: {command}\n{ended.out}{ended.err}"
                assert ended.code == (1 if "fails" in block.markers else 0), told
                if "fails" in block.markers:
                    shown = map(re.escape, " ".join(output.split()).split("..."))
                    assert re.search(".*".join(shown), " ".join(ended.err.split())), told
            case _:
                raise AssertionError(f"{block.place}: cannot be run here, say why: {command}")

    def _install(self) -> None:
        """Install the package here for this process and those that it starts.

        As in an editable installation its code is imported from where it is written.
        """
        installed = self.folder / "installed"
        self._run_python(
            "-m", "pip", "install", "--quiet", "--no-deps", "--no-build-isolation",
            "--disable-pip-version-check", "--target", str(installed), ".",
        )  # fmt: skip
        self.importable += [Path("src").absolute(), installed]
        for path in reversed(self.importable):
            self.make_importable(path)

    def _run_python(self, *arguments: str) -> None:
        """Run Python as a reader would, in a process of its own."""
        paths = os.pathsep.join(map(str, self.importable))
        ended = subprocess.run(
            [sys.executable, *arguments],
            env={**os.environ, "PYTHONPATH": paths, "PYTHONDONTWRITEBYTECODE": "1"},
            capture_output=True, text=True, check=False,
        )  # fmt: skip
        assert ended.returncode == 0, ended.stdout + ended.stderr

    def _check_yaml(self, block: Block) -> None:
        data = YAML(typ="safe", pure=True).load(block.text)
        whole = block.markers.get("part of", "experiment")
        assert isinstance(data, dict), f"{block.place}: neither a template nor an experiment"
        match whole:
            case "experiment":
                finished = "segments" in data or set(data) >= REQUIRED
                self._validate(block, data if finished else COMPLETE | data)
            case "hand":
                hand = YAML(typ="safe", pure=True).load(TEMPLATES / "hand_right.yaml")
                # What else the file says of a segment need not suit another one of its name.
                hand = {name: hand[name] for name in ("title", "size", "segments")}
                self._validate(block, hand | {"segments": hand["segments"] | data})
            case "bones":
                from regkit.fitting.bones import read_bone_map

                file = self.folder / "bones_part.yaml"
                file.write_text(block.text, encoding="utf-8")
                read_bone_map(file)
            case _:
                raise AssertionError(f"{block.place}: no such document: {whole}")

    def _validate(self, block: Block, data: dict[str, Any]) -> None:
        """Check data as the YAML file that a reader would write beside the page's other files."""
        # Examples name the sample data from where they lie themselves.
        if not (self.folder / "data").exists():
            (self.folder / "data").symlink_to(ROOT / "docs" / "examples" / "data")
        file = self.folder / f"block_{block.line}.yaml"
        YAML(typ="safe", pure=True).dump(data, file)
        ended = self.command("validate", file)
        assert ended.code == 0, f"{block.place}: {ended.err}"


def _check_excerpt(block: Block) -> None:
    """Each line of an excerpt has to stand in the file, in the same order."""
    lines = iter((ROOT / block.markers["from"]).read_text(encoding="utf-8").splitlines())
    for line in block.text.splitlines():
        assert line.strip() == "" or line in lines, f"{block.place}: not in the file: {line}"


def _commands(text: str) -> list[tuple[str, str]]:
    """Each command of a block, continued lines joined, and what is shown below it."""
    lines = text.replace("\\\n", " ").splitlines()
    if not any(line.startswith("$ ") for line in lines):
        return [(line, "") for line in lines if line.strip()]
    commands: list[tuple[str, str]] = []
    for line in lines:
        if line.startswith("$ "):
            commands.append((line.removeprefix("$ "), ""))
        else:
            commands[-1] = (commands[-1][0], f"{commands[-1][1]}\n{line}")
    return commands
