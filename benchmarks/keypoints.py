"""Keypoints beside depth: they help a wrong start and do not harm a right one.

Keypoints are made of the true joints: in space with 2.5 cm of noise, or in the picture with 4
pixels; 20 % are outliers anywhere near the body, and in 10 % of the frames left and right are
exchanged. They are read from a CSV file, as those of a detector are. The start is the right one,
one that faces the other way, or one with other arms and legs, and each sequence is tracked with and
without keypoints. ``--develop`` takes other sequences, on which the constants were chosen;
``--seed N`` takes other keypoints and other wrong limbs.
"""

from __future__ import annotations

import sys
import warnings
from dataclasses import dataclass
from pathlib import Path
from tempfile import TemporaryDirectory

import numpy as np
from _suite import PREPROCESSORS, last_line, own_template, recordings

import regkit
from regkit.config.document import Document
from regkit.config.yaml import yaml_value
from regkit.interfaces import Recording, Template
from regkit.observation import Truth
from regkit.search.limbs import limbs_of
from regkit.skeleton import Pose
from regkit.system.optional import one_blas_thread
from regkit_plugins.datasets.synthetic import Synthetic
from regkit_synthesis.samples.keypoints import write_keypoints

DEVELOP = {
    "kind": "synthetic", "camera": "sr4000", "noise": 0.008, "defaults": {"frames": 60},
    "takes": {
        f"{body}_{name}{'_fast' if speed > 1 else ''}": {
            "body": body,
            "motion": {"kind": "clip", "name": name, "speed": speed, "way": 0.1, "ahead": False},
            "view": {"heading_deg": heading, "place": [0.0, 0.8, 3.2]},
        }
        for name, body, heading, speed in (
            ("dance_a", "average", 10, 1), ("spin", "average", 0, 1),
            ("spinkick", "small", -20, 0.7), ("dance_a", "small", 50, 1.5),
            ("run", "small", 70, 1), ("jump", "average", -30, 1),
        )
    },
}  # fmt: skip
"""Sequences that are not in the preset ``people``."""


@dataclass(frozen=True)
class Case:
    """A sequence with its template, its right start and its keypoints' files."""

    recording: Recording
    truth: Truth
    template: Template
    start: Pose
    files: dict[str, Path]


def wrong_starts(case: Case, random: np.random.Generator) -> dict[str, Pose]:
    """Returns a start that faces the other way, and one with other arms and legs."""
    body = case.template.body(case.template.candidate_sizes()[0])
    turned = case.start.root @ np.diag([-1.0, 1.0, -1.0, 1.0])
    balls, hinges = body.skeleton.limits.sampled(random, 1)
    other = case.start
    for limb in limbs_of(body):
        if "arm" in limb.name or "thigh" in limb.name:
            other = limb.rotated(other, balls[0], hinges[0])
    mirrored = Pose(turned, case.start.balls, case.start.hinges)
    return {"right": case.start, "turned": mirrored, "limbs": other}


def error_cm(case: Case, start: Pose, keypoints: Path | None) -> float:
    """Returns the mean raw joint error of a track from a start [cm]."""
    tracked = regkit.track(
        case.recording, case.template, preprocessor=yaml_value(PREPROCESSORS["human"]),
        start=start, keypoints=keypoints,
    )  # fmt: skip
    return float(tracked.measure(case.truth).joint_error_raw_cm or np.nan)


def cases(folder: Path, seed: int, *, develop: bool) -> list[Case]:
    """Returns the sequences, the right start being what the search finds without keypoints."""
    chosen: list[Recording] = list(recordings("human"))
    if develop:
        chosen = Document(DEVELOP, {(): "develop"}).validated(Synthetic).chosen()
    found = []
    for index, recording in enumerate(chosen):
        truth = recording.truth()
        assert truth is not None
        random, frames = np.random.default_rng([seed, index]), list(recording.frames())
        own = folder / recording.name
        own.mkdir()
        files = {kind: own / f"{kind}.csv" for kind in ("space", "picture")}
        for file, camera in zip(files.values(), (None, frames[0].camera), strict=True):
            write_keypoints(file, truth.joints, truth.positions, random, camera)
        subject = recording.name.partition("_")[0]
        template = regkit.load_template(yaml_value(own_template(f"human_{subject}")))
        first = regkit.register(
            frames[0], template, preprocessor=yaml_value(PREPROCESSORS["human"])
        )
        found.append(Case(recording, truth, template, first.pose, files))
    return found


def main() -> None:
    """Prints a row for each sequence and start."""
    develop = "--develop" in sys.argv
    seed = int(sys.argv[sys.argv.index("--seed") + 1]) if "--seed" in sys.argv else 0
    print("| sequence | start | none [cm] | space [cm] | picture [cm] |\n|---|---|--:|--:|--:|")
    # What was exchanged back is told for each file.
    warnings.simplefilter("ignore", regkit.RegkitWarning)
    found: dict[str, list[list[float]]] = {"right": [], "turned": [], "limbs": []}
    with TemporaryDirectory() as temporary, one_blas_thread():
        for index, case in enumerate(cases(Path(temporary), seed, develop=develop)):
            random = np.random.default_rng([seed, index])
            for start, pose in wrong_starts(case, random).items():
                errors = [error_cm(case, pose, file) for file in (None, *case.files.values())]
                found[start].append(errors)
                shown = " | ".join(f"{error:.2f}" for error in errors)
                print(f"| {case.recording.name} | {start} | {shown} |", flush=True)
    figures: dict[str, object] = {}
    for start, rows in found.items():
        errors = np.array(rows)
        for column, kind in ((1, "space"), (2, "picture")):
            figures[f"{start}_{kind}"] = {
                "none_cm": round(float(errors[:, 0].mean()), 2),
                "keypoints_cm": round(float(errors[:, column].mean()), 2),
                "worst_harm_cm": round(float((errors[:, column] - errors[:, 0]).max()), 2),
            }
    last_line({"sequences": "develop" if develop else "people", **figures})


if __name__ == "__main__":
    main()
