"""The synthetic recordings that the benchmarks of accuracy run on, and one row of their tables."""

from __future__ import annotations

import json
import subprocess
import sys
from collections.abc import Sequence
from concurrent.futures import ProcessPoolExecutor
from pathlib import Path
from tempfile import TemporaryDirectory

from regkit.config.document import Document
from regkit.experiment import Experiment, Outcome, run
from regkit.metrics import Measure

FOLDER = Path("results/suite")
"""Where the recordings are, made when they are not there (two minutes)."""

UTD = Path(__file__).parent.parent / "docs" / "examples" / "utd.yaml"
"""The experiment on real data."""

OBSERVERS = {
    "human": "{kind: points, voxel: 0.03, sigma: 0.01}",
    "hand": "{kind: points, voxel: 0.008, sigma: 0.003}",
}
EXPERIMENT = """\
name: suite
dataset: {{kind: depth, root: {folder}}}
template: {template}
preprocessor: {preprocessor}
methods: {{method: {method}}}
"""


def bodies(kind: str) -> list[Path]:
    """The folders of the recordings of each ``human`` or ``hand``, or of one; made if need be."""
    if not FOLDER.is_dir():
        command = [sys.executable, "-m", "regkit_synthesis", str(FOLDER), "--suite"]
        subprocess.run(command, check=True, stdout=sys.stderr)
    return sorted(folder for folder in FOLDER.absolute().glob(f"{kind}*") if folder.is_dir())


def tracked(
    kind: str, method: str, settings: Sequence[str] = (), template: str | None = None
) -> dict[str, Measure]:
    """The figures of a method, written as in YAML, on all recordings of a kind, by name.

    Without another template each body's own is taken, which has the right lengths.
    """
    jobs = [
        (folder, recording.name, OBSERVERS[kind.split("_")[0]], method, tuple(settings), template)
        for folder in bodies(kind)
        for recording in sorted(folder.iterdir())
        if recording.is_dir()
    ]
    with ProcessPoolExecutor() as pool:
        return dict(pool.map(_tracked, jobs))


def _tracked(
    job: tuple[Path, str, str, str, tuple[str, ...], str | None],
) -> tuple[str, Measure]:
    folder, recording, preprocessor, method, settings, template = job
    own = folder.with_suffix(".yaml")
    size = Document.read(own).data["size"]["value"]
    template = template or f"{{kind: file, path: {own}, size: {size}}}"
    with TemporaryDirectory() as temporary:
        file = Path(temporary) / "experiment.yaml"
        file.write_text(
            EXPERIMENT.format(
                folder=folder, template=template, preprocessor=preprocessor, method=method
            )
        )
        experiment = Experiment.read(file, (*settings, f"dataset.recordings=[{recording}]"))
        measures = _measures(run(experiment, Path(temporary) / "out", figures=False))
    return f"{folder.name}/{recording}", measures[recording]


def tracked_utd(folder: Path, method: str) -> dict[str, Measure]:
    """The figures of a method on the recordings of UTD-MHAD in a folder, by name."""
    with TemporaryDirectory() as temporary:
        settings = (f"dataset.root={folder.absolute()}", f"methods={{method: {method}}}")
        experiment = Experiment.read(UTD, settings)
        return _measures(run(experiment, Path(temporary) / "out", figures=False))


def _measures(outcome: Outcome) -> dict[str, Measure]:
    for recording, reason in outcome.failures["method"].items():
        print(f"{recording} failed: {reason}", file=sys.stderr)
    return outcome.measures["method"]


def mean(measures: dict[str, Measure], figure: str) -> float:
    """The mean of a figure over recordings."""
    return sum(getattr(measure, figure) for measure in measures.values()) / len(measures)


def row(name: str, measures: dict[str, Measure]) -> dict[str, float]:
    """Prints the mean figures of a method as a row of Markdown, and gives them back."""
    figures = {
        "raw_cm": round(mean(measures, "joint_error_raw_cm"), 2),
        "adjusted_cm": round(mean(measures, "joint_error_adjusted_cm"), 2),
        "worst_raw_cm": round(max(m.joint_error_raw_cm or 0.0 for m in measures.values()), 2),
        "pck_percent": round(mean(measures, "pck_percent"), 1),
        "evaluations": round(mean(measures, "evaluations_per_frame"), 1),
    }
    print(f"| {name} | " + " | ".join(f"{figure:g}" for figure in figures.values()) + " |")
    sys.stdout.flush()
    return figures


HEADER = """\
| method | raw [cm] | adjusted [cm] | worst raw [cm] | PCK [%] | evaluations |
|---|--:|--:|--:|--:|--:|"""


def last_line(figures: object) -> None:
    """Prints the figures as one JSON object, the last line of every benchmark."""
    print(json.dumps(figures))
