"""A small experiment on two recordings of two frames, and what tests do to it."""

import json
import shutil
import subprocess
import time
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path
from typing import Literal, NamedTuple

from places import EXAMPLES

from regkit.config.plugin import register
from regkit.interfaces import BoundTracker, Registrar, RegistrationResult, Tracker

FRAMES = 2
EXPERIMENT = """\
name: small
dataset: {{kind: depth, root: {root}}}
template: {{kind: human, height: 1.7}}
preprocessor: {{kind: points, voxel: 0.05, sigma: 0.03}}
start: {{kind: given, root: {{position: [-0.05, -0.05, 3.25], rotation_deg: [180, 0, 0]}}}}
segmentation: []
methods:
  gsog: {{kind: direct, shape: gsog, kernel: correlation, \
solver: {{kind: lbfgs, max_iterations: 4}}}}
"""
ANOTHER = """\
  {name}: {{kind: direct, shape: {shape}, kernel: correlation, \
solver: {{kind: lbfgs, max_iterations: 4}}}}
"""
TIMES = ("fps", "preprocessing_ms", "registering_ms")
"""The figures that are not the same when the same is done again."""
QUICK = ("--set", "dataset.recordings=[first]", "--set", "dataset.frames=1", "--no-figures")
"""For runs of which it only matters that they take place."""


class Files(NamedTuple):
    """A small experiment on two recordings, and where its results go."""

    experiment: Path
    data: Path
    out: Path

    def metrics(self) -> dict:
        return json.loads((self.out / "metrics.json").read_text())["methods"]

    def written(self) -> dict[str, int]:
        """When each file of the recordings was written."""
        return {
            str(path.relative_to(self.out)): path.stat().st_mtime_ns
            for path in sorted(self.out.glob("*/*/*"))
        }


def copy_recording(folder: Path) -> None:
    source = EXAMPLES / "data" / "human_walk"
    (folder / "depth").mkdir(parents=True)
    for frame in range(FRAMES):
        name = f"depth/{frame:06d}.png"
        shutil.copy(source / name, folder / name)
    for name in ("camera.json", "truth.csv"):
        shutil.copy(source / name, folder / name)
    (folder / "sequence.yaml").write_text(f"name: {folder.name}\n")


def small(folder: Path) -> Files:
    data = folder / "data"
    for name in ("first", "second"):
        copy_recording(data / name)
    experiment = folder / "small.yaml"
    experiment.write_text(EXPERIMENT.format(root="data"))
    return Files(experiment, data, folder / "out")


def add_method(experiment: Path, name: str, shape: str) -> None:
    with experiment.open("a") as stream:
        stream.write(ANOTHER.format(name=name, shape=shape))


@dataclass(frozen=True)
class Stepping(BoundTracker):
    """Holds the last pose, after something was done."""

    registrar: Registrar
    before: Callable[[], object]

    def step(self, observation, past) -> RegistrationResult:
        self.before()
        return self.registrar.register(observation, [past.last.pose])


def counting() -> list[str]:
    """Register the tracker ``counting``, and return the list that grows with each of its steps."""
    steps: list[str] = []

    @register
    class Counting(Tracker):
        """Holds the last pose and counts."""

        kind: Literal["counting"] = "counting"

        def bind(self, registrar) -> BoundTracker:
            return Stepping(registrar, lambda: steps.append(type(registrar.method.shape).__name__))

    return steps


def damage(image: Path) -> bytes:
    content = image.read_bytes()
    image.write_bytes(content[: len(content) // 2])
    return content


def figures_but_times(out: Path) -> list:
    """All figures of a run but the frames per second, in the order in which they are written."""

    def without(value):
        if not isinstance(value, dict):
            return value
        return [(key, without(inner)) for key, inner in value.items() if key not in TIMES]

    return without(json.loads((out / "metrics.json").read_text()))


@dataclass(frozen=True)
class Started:
    """The command line in a process of its own."""

    process: subprocess.Popen

    def wait_for(self, path: Path) -> None:
        """Until a file is there, while the command still runs."""
        end = time.monotonic() + 120.0
        while not path.exists():
            assert self.process.poll() is None, self.process.communicate()
            assert time.monotonic() < end
            time.sleep(0.01)
