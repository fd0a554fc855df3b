"""Results folders, as ``report`` and ``export`` read them."""

from __future__ import annotations

import hashlib
import json
import os
import subprocess
import sys
import tempfile
from collections.abc import Iterator
from functools import lru_cache
from pathlib import Path
from typing import Any

import numpy as np

from regkit.experiment import found, report
from regkit.experiment.tracked_motion import read_tracked_motion
from regkit.interchange.motion import TrackedMotion
from regkit.interchange.motions import write_motion
from regkit.tracking import Verdict
from regkit.viewer.run_scene import run_scene
from regkit.viewer.track_file import read_scene
from regkit.viewer.track_scene import TrackScene
from tests.fuzz import oracles
from tests.fuzz.kind import Damaged, Files, Kind

FOLDER = "REGKIT_FUZZ_RESULTS"
"""Name of the environment variable with the folder of results that other processes have made."""
ROOT = Path(__file__).parents[3]
TRACK = "icp/human_walk"
CHECKSUMS = "checksums.json"
EXPERIMENT = f"""\
name: seed
dataset: {{kind: depth, root: {ROOT}/docs/examples/data/human_walk, frames: 2}}
template: {{kind: human, height: 1.7}}
preprocessor: {{kind: points, voxel: 0.08, sigma: 0.05}}
start: {{kind: given, root: {{position: [-0.05, -0.05, 3.25], rotation_deg: [180, 0, 0]}}}}
methods:
  icp: {{preset: icp}}
"""
# With a clock that ticks once per look, the measured times are those of the last run.
RUN = """\
import itertools, sys, time
ticks = itertools.count()
time.perf_counter = lambda: next(ticks) / 1024
from regkit.cli import main
sys.argv = ["regkit", "run", "{experiment}", "--out", "{out}", "--no-figures"]
main()
"""


def make(folder: Path) -> None:
    """Make the results of a small run in a folder that does not exist."""
    with tempfile.TemporaryDirectory() as scratch:
        experiment = Path(scratch) / "seed.yaml"
        experiment.write_text(EXPERIMENT)
        code = RUN.format(experiment=experiment, out=folder)
        subprocess.run([sys.executable, "-c", code], check=True, capture_output=True)


@lru_cache
def seeds() -> list[Files]:
    with tempfile.TemporaryDirectory() as scratch:
        folder = Path(os.environ.get(FOLDER) or Path(scratch) / "results")
        if not folder.exists():
            make(folder)
        files = (path for path in sorted(folder.rglob("*")) if path.is_file())
        return [{path.relative_to(folder).as_posix(): path.read_bytes() for path in files}]


@lru_cache
def _sound() -> tuple[dict[str, Any], TrackedMotion]:
    """What the undamaged folder holds."""
    with tempfile.TemporaryDirectory() as scratch:
        folder = Path(scratch)
        for name, content in seeds()[0].items():
            (folder / name).parent.mkdir(parents=True, exist_ok=True)
            (folder / name).write_bytes(content)
        return found(folder)[0], read_tracked_motion(folder / TRACK)


def _reported(folder: Path) -> Any:
    """All that ``regkit report`` does but the figures."""
    measures, failures = found(folder)
    report(folder, measures, failures, figures=False)
    return measures


def _as_measured(measures: Any, file: Damaged) -> Iterator[str]:
    """What is reported as measured was measured, or is absent."""
    for method, recordings in measures.items():
        for recording, measure in recordings.items():
            if measure != _sound()[0].get(method, {}).get(recording):
                yield f"{method}/{recording}: {measure}"


def _exported(folder: Path) -> TrackedMotion:
    """All that ``regkit export`` does."""
    motion = read_tracked_motion(folder / TRACK)
    write_motion(motion, folder / "motion.bvh")
    return motion


def _viewed(folder: Path) -> TrackScene:
    """All that ``regkit view`` reads of a track, as the page gets it."""
    track = read_scene(folder / TRACK)
    scene = run_scene("seed", {"walk": {"icp": lambda: track}}, {"icp": "#000000"})
    if scene is not None:
        scene.json()
    return track


def _can_be_shown(track: TrackScene, file: Damaged) -> Iterator[str]:
    yield from oracles.numbers(track.transforms, "transforms", most=oracles.FARTHEST)
    for frame in range(len(track.points)):
        yield from oracles.numbers(track.points.at(frame), "points", most=oracles.LARGEST)
    if not 0.0 < track.fps < np.inf:
        yield f"fps: {track.fps}"


def _as_tracked(motion: TrackedMotion, file: Damaged) -> Iterator[str]:
    """What is exported was tracked."""
    sound = _sound()[1]
    yield from oracles.body(motion.body)
    if motion.fps != sound.fps:
        yield f"fps: {motion.fps}"
    if motion.transforms.shape != sound.transforms.shape:
        yield f"transforms: of shape {motion.transforms.shape}"
    elif not np.allclose(motion.transforms, sound.transforms, atol=1e-6):
        yield "transforms: not those that were tracked"


def _sealed(folder: Path) -> Path:
    """The folder with checksums that are right, as if the damage had been there before them."""
    for file in folder.glob(f"*/*/{CHECKSUMS}"):
        content = json.loads(file.read_bytes())
        for name in content["files"]:
            content["files"][name] = hashlib.sha256((file.parent / name).read_bytes()).hexdigest()
        file.write_text(json.dumps(content))
    return folder


def _can_be_measured(measures: Any, file: Damaged) -> Iterator[str]:
    for recordings in measures.values():
        for measure in recordings.values():
            known = [value for value in measure.numbers().values() if value is not None]
            yield from oracles.numbers(known, "measure", most=oracles.LARGEST)
            if measure.verdict not in (*Verdict, None):
                yield f"verdict: {measure.verdict}"


def _can_be_tracked(motion: TrackedMotion, file: Damaged) -> Iterator[str]:
    yield from oracles.body(motion.body)
    yield from oracles.numbers(motion.transforms, "transforms", most=oracles.FARTHEST)
    if not 1e-3 < motion.fps < 1e5:
        yield f"fps: {motion.fps}"


REPORTED = {
    f"{TRACK}/measure.json": "json",
    f"{TRACK}/record.npz": "npz",
    f"{TRACK}/{CHECKSUMS}": "json",
    "metrics.json": "json",
    "environment.json": "json",
    "config.yaml": "yaml",
}
EXPORTED = {
    f"{TRACK}/poses.npz": "npz",
    f"{TRACK}/{CHECKSUMS}": "json",
    "config.yaml": "yaml",
    "environment.json": "json",
}
SEALED = {f"{TRACK}/measure.json": "json", f"{TRACK}/record.npz": "npz"}

RESULTS = (
    Kind("results/report", seeds, REPORTED, _reported, _as_measured, whole=True, weight=0.6),
    Kind("results/export", seeds, EXPORTED, _exported, _as_tracked, whole=True, weight=1.5),
    Kind(
        "results/report-sealed",
        seeds,
        SEALED,
        lambda folder: _reported(_sealed(folder)),
        _can_be_measured,
        whole=True,
        weight=0.4,
    ),
    Kind(
        "results/export-sealed",
        seeds,
        {f"{TRACK}/poses.npz": "npz"},
        lambda folder: _exported(_sealed(folder)),
        _can_be_tracked,
        whole=True,
        weight=0.8,
    ),
    Kind(
        "results/scene",
        seeds,
        {f"{TRACK}/scene.npz": "npz"},
        _viewed,
        _can_be_shown,
        whole=True,
        weight=0.8,
    ),
)
