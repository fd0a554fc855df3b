"""Error against the number of primitives and the time per frame: SoG, G-SoG and capsules.

    python benchmarks/tuning.py [--frames N] [--jobs N] [--out FILE]

Each shape model has several numbers of primitives, as they fill the solid body and tuned to the
method, which are the shipped lists. All have the same data and starts. Errors are means over the
recordings of the presets ``people`` (13) and ``smmc_like`` (28), which are rendered on first use,
with each person's own template. The time per frame is the median over all frames, on one thread.
``--frames`` takes only the first frames of each recording; ``--out`` also writes the figures, for
``docs/pictures.py``.
"""

from __future__ import annotations

import argparse
import json
from concurrent.futures import ProcessPoolExecutor
from dataclasses import dataclass
from pathlib import Path
from tempfile import TemporaryDirectory

import numpy as np
from _suite import last_line
from _tuning_shapes import FILLED, SHAPES

from regkit import load_template
from regkit.body import ShapeParameters
from regkit.body.template_file import write_template
from regkit.config.document import Document
from regkit.experiment import Experiment
from regkit.geometry.skinned_mesh import SkinnedMesh
from regkit.metrics import joint_errors, measured
from regkit.system.arrays import Array
from regkit.system.optional import one_blas_thread
from regkit.tracking import TrackRecorder
from regkit.tuning import divided
from regkit_plugins.datasets.synthetic import Synthetic
from regkit_plugins.presets import PEOPLE, SMMC_LIKE

SUITES = {"people": PEOPLE, "smmc_like": SMMC_LIKE}
"""Presets of the recordings."""

HEIGHTS = {"average": 1.6327, "small": 1.4901, "tall": 1.88}
"""True height of each build [m]."""

EXPERIMENT = """\
name: tuning
dataset: {{preset: {preset}, recordings: [{recording}]}}
template: {average}
subjects:
  small: {small}
  tall: {tall}
preprocessor: {{kind: points, voxel: 0.03, sigma: 0.01}}
methods:
{methods}
"""


def templates(folder: Path) -> dict[str, str]:
    """Writes the template of each build with the lists that fill it; returns them in YAML."""
    written = {}
    for build, height in HEIGHTS.items():
        description = load_template({"kind": "human", "build": build}).description()
        body = description.body(build, description.size.value)
        filled: dict[str, dict[str, tuple[ShapeParameters, ...]]] = {
            f"{kind}/filled_{count}": divided(body, made, count, alike=True)
            for kind, (made, counts) in FILLED.items()
            for count in counts
        }
        more = description.model_copy(update={"shapes": {**description.shapes, **filled}})
        assert description.mesh is not None
        file = folder / f"{build}.yaml"
        write_template(file, more, SkinnedMesh.read(description.mesh), "For a benchmark.")
        written[build] = f"{{kind: file, path: {file}, size: {height}}}"
    return written


@dataclass(frozen=True)
class Job:
    """A recording to track with every shape.

    Attributes:
        suite: Its preset.
        recording: Its name.
        templates: Template of each build, in YAML.
        frames: Number of frames; all if None.
    """

    suite: Path
    recording: str
    templates: dict[str, str]
    frames: int | None

    def run(self) -> tuple[Array, Array]:
        """Tracks it from one start.

        Returns:
            Raw and adjusted error of each shape (S, 2) [cm], and its seconds per frame (S, L).
        """
        methods = "\n".join(f"  shape_{at}: {one.method}" for at, one in enumerate(SHAPES))
        given = {"preset": self.suite, "recording": self.recording, "methods": methods}
        with TemporaryDirectory() as folder, one_blas_thread():
            file = Path(folder) / "experiment.yaml"
            file.write_text(EXPERIMENT.format(**given, **self.templates))
            settings = () if self.frames is None else (f"dataset.frames={self.frames}",)
            experiment = Experiment.read(file, settings)
            (recording,) = experiment.dataset.chosen()
            recording.prepare()
            session = experiment.session(recording)
            start, truth = session.begin(), recording.truth()
            assert truth is not None
            errors, seconds = [], []
            for method in experiment.methods.values():
                registrar = method.bind(start.body)
                recorder = TrackRecorder(registrar, recording.fps, session.observation)
                tracker = method.tracker or experiment.tracker
                for frame in session.tracked(registrar, tracker, start.pose):
                    recorder.add(frame)
                track = recorder.track()
                found = joint_errors(track, start.body, truth, {})
                measure = measured(track, start.body, found, recording.fps, start)
                errors.append([measure.joint_error_raw_cm, measure.joint_error_adjusted_cm])
                seconds.append(track.seconds)
        return np.array(errors, dtype=float), np.array(seconds)


def names(preset: Path) -> list[str]:
    """Returns the names of the recordings of a preset."""
    return [one.name for one in Document.read(preset).validated(Synthetic).chosen()]


def main() -> None:
    """Prints the table, and its figures as one JSON object in the last line."""
    parser = argparse.ArgumentParser(description="Error against number of primitives and time.")
    parser.add_argument("--frames", type=int, help="first frames of each recording only")
    parser.add_argument("--jobs", type=int, default=2, help="number of processes")
    parser.add_argument("--out", type=Path, help="JSON file of the figures to write too")
    given = parser.parse_args()
    found: dict[str, Array] = {}
    seconds: list[Array] = []
    with TemporaryDirectory() as folder, ProcessPoolExecutor(given.jobs) as pool:
        bodies = templates(Path(folder))
        for suite, preset in SUITES.items():
            jobs = [Job(preset, name, bodies, given.frames) for name in names(preset)]
            errors, spent = zip(*pool.map(Job.run, jobs), strict=True)
            found[suite] = np.mean(errors, axis=0)
            seconds += spent
    milliseconds = 1000.0 * np.median(np.concatenate(seconds, axis=1), axis=1)
    columns = " | ".join(f"`{name}`, raw / adjusted [cm]" for name in SUITES)
    print(f"| shape model | primitives | {columns} | time per frame [ms] |\n|---|--:|--:|--:|--:|")
    rows = []
    for at, (shape, own) in enumerate(zip(SHAPES, milliseconds.tolist(), strict=True)):
        cells = " | ".join(f"{each[at][0]:.2f} / {each[at][1]:.2f}" for each in found.values())
        print(f"| {shape.curve} | {shape.count} | {cells} | {own:.2f} |")
        each = {name: np.round(errors[at], 3).tolist() for name, errors in found.items()}
        rows.append({"curve": shape.curve, "primitives": shape.count, **each, "ms": round(own, 3)})
    figures = {"frames": given.frames, "shapes": rows}
    if given.out is not None:
        given.out.write_text(json.dumps(figures, indent=1) + "\n")
    last_line(figures)


if __name__ == "__main__":
    main()
