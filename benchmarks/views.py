"""Several cameras: accuracy, extrinsics, a camera that stops, and a clock that is wrong.

    python benchmarks/views.py [RECORDING ...]

The 13 sequences of the preset ``people`` as 1, 2 and 4 cameras around the body see them, tracked by
``best`` with the true height. Constants were chosen on the preset ``smmc_like``.
"""

from __future__ import annotations

import json
import sys
import time
import warnings
from collections.abc import Callable, Iterable

import numpy as np
from _views_takes import PREPROCESSOR, seen, template_of

import regkit
from regkit.api.pipeline import Pipeline
from regkit.calibration.extrinsics import Extrinsics
from regkit.geometry.rigid import inverse, log
from regkit.interfaces import Recording
from regkit.metrics import joint_errors
from regkit.observation import Frame, Truth
from regkit.system.optional import one_blas_thread
from regkit.tracking.given_frames import GivenFrames
from regkit_plugins.datasets.synthetic import SyntheticRecording

LATE = 3
"""Shift of the second camera's clock, in frames at twice the frame rate: 50 ms."""

PRESET = "people"

TIMED = ("average_walk_oblique", "average_dance", "small_walk_fast", "small_jump")
"""Recordings on which time is measured."""


def tracked(
    recording: Recording, of: SyntheticRecording, truth: Truth
) -> tuple[np.ndarray, list[str]]:
    """Returns the mean error of each frame [cm], and what was told."""
    with warnings.catch_warnings(record=True) as told:
        warnings.simplefilter("always")
        track = regkit.track(recording, template_of(of), segmentation=[], preprocessor=PREPROCESSOR)
    errors = 100.0 * joint_errors(track.track, track.body, truth, {}).raw
    notes = [str(one.message) for one in told]
    return np.nanmean(errors, axis=1), notes


def accuracy(names: set[str]) -> dict[str, dict[str, float]]:
    """Measures 1, 2 and 4 cameras."""
    print("| cameras | raw [cm] | worst frame, mean [cm] | worst frame of all [cm] |")
    print("|--:|--:|--:|--:|", flush=True)
    found = {}
    for cameras in (1, 2, 4):
        errors = []
        for recording in chosen(seen(PRESET, cameras), names):
            truth = recording.truth()
            assert truth is not None
            errors.append(tracked(recording, recording, truth)[0])
        worst = [one.max() for one in errors]
        figures = {
            "raw_cm": round(float(np.mean([one.mean() for one in errors])), 2),
            "worst_frame_cm": round(float(np.mean(worst)), 2),
            "worst_of_all_cm": round(float(np.max(worst)), 2),
        }
        print(f"| {cameras} | " + " | ".join(f"{one:g}" for one in figures.values()) + " |")
        sys.stdout.flush()
        found[str(cameras)] = figures
    return found


def cost(names: set[str]) -> dict[str, float]:
    """Measures the processor time of a frame with 1, 2 and 4 cameras, relative to one."""
    ratios = []
    for one, two, four in zip(*(chosen(seen(PRESET, n), names) for n in (1, 2, 4)), strict=True):
        if one.name in TIMED or names:
            times = [frame_time(recording) for recording in (one, two, four)]
            ratios.append(np.array(times) / times[0])
    means = np.mean(ratios, axis=0)
    print(f"\ntime of a frame with 1, 2, 4 cameras: {', '.join(f'{one:.1f}' for one in means)}")
    return {str(count): round(float(one), 2) for count, one in zip((1, 2, 4), means, strict=True)}


def frame_time(recording: SyntheticRecording) -> float:
    """Returns the least processor time of three runs, per frame [s]."""
    pipeline = Pipeline.of(
        template_of(recording), segmentation=[], preprocessor=PREPROCESSOR, place="benchmark"
    )
    session = pipeline.session(recording)
    start = session.begin()
    registrar, frames, times = pipeline.method.bind(start.body), list(recording.frames()), []
    for _ in range(3):
        follower = session.follower(registrar, pipeline.tracker, start.pose)
        begun = time.process_time()
        for frame in frames:
            follower.follow(frame)
        times.append((time.process_time() - begun) / len(frames))
    return min(times)


def faults(names: set[str]) -> dict[str, dict[str, float]]:
    """Measures two cameras of which one stops in the middle, or has a wrong clock."""
    kinds: dict[str, Callable[[list[Frame]], list[Frame]]] = {
        "alone": lambda frames: [one.views[0].data for one in frames[:-LATE:2]],
        "both": lambda frames: frames[:-LATE:2],
        "stopped": stopped,
        "shifted": shifted,
    }
    rows: dict[str, list[float]] = {kind: [] for kind in kinds}
    told = dict.fromkeys(kinds, 0)
    print("\n| recording | one camera [cm] | two | one stops | clock 50 ms off | told |")
    print("|---|--:|--:|--:|--:|---|", flush=True)
    for recording in chosen(seen(PRESET, 2, times=2), names):
        whole = recording.truth()
        assert whole is not None
        truth = Truth(whole.joints, whole.positions[:-LATE:2])
        frames, notes = list(recording.frames()), ""
        for kind, change in kinds.items():
            given = tuple(change(frames))
            made = GivenFrames(name=recording.name, fps=30.0, length=len(given), given=given)
            errors, notes_of = tracked(made, recording, truth)
            rows[kind].append(float(errors.mean()))
            clocks = [note for note in notes_of if "clock" in note]
            told[kind] += bool(clocks)
            notes += f"{kind}: clock; " if clocks else ""
        last = " | ".join(f"{errors[-1]:.2f}" for errors in rows.values())
        print(f"| {recording.name} | {last} | {notes} |", flush=True)
    means = {kind: round(float(np.mean(errors)), 2) for kind, errors in rows.items()}
    print("| mean | " + " | ".join(f"{one:g}" for one in means.values()) + " | |", flush=True)
    alone = np.array(rows["alone"])
    return {
        kind: {
            "raw_cm": means[kind],
            "worse_than_alone_at_most_cm": round(float((np.array(rows[kind]) - alone).max()), 2),
            "told": told[kind],
            "of": len(alone),
        }
        for kind in kinds
    }


def stopped(frames: list[Frame]) -> list[Frame]:
    """Returns the frames of two cameras, of which the second stops in the middle."""
    both = frames[:-LATE:2]
    return [
        one if index < len(both) // 2 else Frame.of_views(one.views[:1])
        for index, one in enumerate(both)
    ]


def shifted(frames: list[Frame]) -> list[Frame]:
    """Returns the frames of two cameras, of which the second shows what comes 50 ms later."""
    return [
        Frame.of_views([one.views[0], late.views[1]])
        for one, late in zip(frames[:-LATE:2], frames[LATE::2], strict=False)
    ]


def extrinsics(names: set[str]) -> dict[str, float]:
    """Measures the poses of cameras that are found from the body."""
    print("\n| recording | position [cm] | angle [deg] | verdict | time [s] |")
    print("|---|--:|--:|---|--:|", flush=True)
    places, angles = [], []
    for recording in chosen(seen(PRESET, 2), names):
        begun = time.process_time()
        settings = Extrinsics.model_validate({
            "template": template_of(recording), "segmentation": [], "preprocessor": PREPROCESSOR,
        })  # fmt: skip
        found = settings.found(recording.cameras(), place=recording.name)
        name, true = list(recording.camera_poses().items())[1]
        error = log(inverse(true) @ found.poses[name])
        place = 100.0 * float(np.linalg.norm(found.poses[name][:3, 3] - true[:3, 3]))
        angle = float(np.degrees(np.linalg.norm(error[3:])))
        places.append(place)
        angles.append(angle)
        spent = time.process_time() - begun
        print(f"| {recording.name} | {place:.2f} | {angle:.2f} | {found.verdict} | {spent:.0f} |")
        sys.stdout.flush()
    return {
        "position_median_cm": round(float(np.median(places)), 2),
        "position_worst_cm": round(max(places), 2),
        "angle_median_deg": round(float(np.median(angles)), 2),
        "angle_worst_deg": round(max(angles), 2),
        "within_1_cm_and_1_deg": sum(
            place <= 1.0 and angle <= 1.0 for place, angle in zip(places, angles, strict=True)
        ),
        "of": len(places),
    }


def chosen(recordings: Iterable[SyntheticRecording], names: set[str]) -> list[SyntheticRecording]:
    """Returns the recordings of some names, or all."""
    return [one for one in recordings if not names or one.name in names]


def main() -> None:
    """Prints tables, and the figures as one line of JSON."""
    names = set(sys.argv[1:])
    with one_blas_thread():
        figures = {
            "views": accuracy(names),
            "cost": cost(names),
            "faults": faults(names),
            "extrinsics": extrinsics(names),
        }
    print(json.dumps({"threads": 1, **figures}))


if __name__ == "__main__":
    main()
