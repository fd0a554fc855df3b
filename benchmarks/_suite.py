"""Synthetic recordings of the accuracy benchmarks, and rows of their tables."""

from __future__ import annotations

import json
import sys
from collections.abc import Mapping, Sequence
from concurrent.futures import ProcessPoolExecutor
from pathlib import Path
from tempfile import TemporaryDirectory

from regkit.config.document import Document
from regkit.experiment import Experiment, Outcome, run
from regkit.metrics import Measure
from regkit.system.optional import one_blas_thread
from regkit_plugins.datasets.synthetic import Synthetic, SyntheticRecording
from regkit_plugins.presets import HANDS, PEOPLE
from regkit_synthesis.assets import slim_hand
from regkit_synthesis.templates import right_hand_template

PRESETS = {"human": PEOPLE, "hand": HANDS}
"""Dataset of each type of body."""

TEMPLATES = {
    "human_average": "{kind: human, height: 1.6327}",
    "human_small": "{kind: human, build: small, height: 1.4901}",
    "hand_average": "{kind: hand, length: 0.1858}",
    "hand_slim": "{kind: file, path: SLIM_HAND, size: 0.1938}",
}
"""Template of each subject, with the true lengths."""

SLIM_HAND = Path("results/slim_hand.yaml")
"""Template of the slim hand, created if missing (half a minute)."""

UTD = Path(__file__).parent.parent / "docs" / "examples" / "utd.yaml"
"""The experiment on real data."""

PREPROCESSORS = {
    "human": "{kind: points, voxel: 0.03, sigma: 0.01}",
    "hand": "{kind: points, voxel: 0.008, sigma: 0.003}",
}
EXPERIMENT = """\
name: suite
dataset: {{preset: {preset}}}
template: {template}
preprocessor: {preprocessor}
methods: {{method: {method}}}
"""


def recordings(kind: str) -> list[SyntheticRecording]:
    """Returns the recordings of ``human``, ``hand``, or one of their subjects.

    A subject is, for example, ``human_small``. The recordings are rendered on first use (two
    minutes for all), and stored in the cache.
    """
    kind, _, subject = kind.partition("_")
    dataset = Document.read(PRESETS[kind]).validated(Synthetic)
    return [
        recording
        for recording in dataset.chosen()
        if isinstance(recording, SyntheticRecording) and subject in ("", recording.subject)
    ]


def tracked(
    kind: str, method: str, settings: Sequence[str] = (), template: str | None = None
) -> dict[str, Measure]:
    """Returns the metrics of a method, in YAML, on all recordings of a type, by name.

    By default each subject's own template is used, which has the true lengths.
    """
    body = kind.partition("_")[0]
    jobs = [
        (body, recording.name, template or own_template(f"{body}_{recording.subject}"), method)
        for recording in recordings(kind)
    ]
    with ProcessPoolExecutor() as pool:
        return dict(pool.map(_tracked, jobs, [tuple(settings)] * len(jobs)))


def own_template(subject: str) -> str:
    """Returns the template of a subject, in YAML."""
    if subject == "hand_slim" and not SLIM_HAND.is_file():
        SLIM_HAND.parent.mkdir(parents=True, exist_ok=True)
        right_hand_template(slim_hand(), "A slim right hand", "a slim hand").write(SLIM_HAND)
    return TEMPLATES[subject].replace("SLIM_HAND", str(SLIM_HAND.absolute()))


def _tracked(job: tuple[str, str, str, str], settings: tuple[str, ...]) -> tuple[str, Measure]:
    body, recording, template, method = job
    with TemporaryDirectory() as temporary, one_blas_thread():
        file = Path(temporary) / "experiment.yaml"
        file.write_text(
            EXPERIMENT.format(
                preset=PRESETS[body],
                template=template,
                preprocessor=PREPROCESSORS[body],
                method=method,
            )
        )
        experiment = Experiment.read(file, (*settings, f"dataset.recordings=[{recording}]"))
        measures = _measures(run(experiment, Path(temporary) / "out", figures=False))
    return recording, measures[recording]


def tracked_utd(folder: Path, method: str) -> dict[str, Measure]:
    """Returns the metrics of a method on the recordings of UTD-MHAD in a folder, by name."""
    with TemporaryDirectory() as temporary, one_blas_thread():
        settings = (f"dataset.root={folder.absolute()}", f"methods={{method: {method}}}")
        experiment = Experiment.read(UTD, settings)
        return _measures(run(experiment, Path(temporary) / "out", figures=False))


def _measures(outcome: Outcome) -> dict[str, Measure]:
    for recording, reason in outcome.failures["method"].items():
        print(f"{recording} failed: {reason}", file=sys.stderr)
    return outcome.measures["method"]


def mean(measures: dict[str, Measure], figure: str) -> float:
    """Returns the mean of a metric over recordings."""
    return sum(getattr(measure, figure) for measure in measures.values()) / len(measures)


def row(name: str, measures: dict[str, Measure]) -> dict[str, float]:
    """Prints the mean metrics of a method as a row of Markdown, and returns them."""
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


def last_line(figures: Mapping[str, object]) -> None:
    """Prints the figures as one JSON object in the last line; each process had one thread."""
    print(json.dumps({"threads": 1, **figures}))
