"""Long recordings: memory and processor time per frame.

The method ``best`` tracks the sample walk repeated to ``FRAMES`` frames; then a registrar that
immediately returns its start runs through ``MANY`` frames, to measure the loop and the recorder
alone.
"""

from __future__ import annotations

import json
import resource
import subprocess
import sys
import time
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from pathlib import Path

import numpy as np

import regkit
from regkit.interfaces import (
    Evaluation,
    Method,
    Preprocessor,
    Prior,
    Recording,
    Registrar,
    RegistrationResult,
    StartSearch,
    Template,
    Tracker,
)
from regkit.observation import Frame, Observation
from regkit.skeleton import Pose
from regkit.system.optional import one_thread
from regkit.tracking import Session, TrackRecorder

WALK = Path(__file__).parent.parent / "docs" / "examples" / "data" / "human_walk"
FRAMES = 3_000
MANY = 100_000
START = {"root": {"position": [-0.05, -0.05, 3.25], "rotation_deg": [180, 0, 0]}}


@dataclass(frozen=True)
class Repeated(Recording):
    """A recording that repeats another one, read again each time."""

    recording: Recording

    def frames(self) -> Iterator[Frame]:
        """Yields the frames, starting over after the last one."""
        left = self.length
        while left:
            for frame in self.recording.frames():
                if not left:
                    return
                left -= 1
                yield frame

    def truth(self) -> None:
        """Returns None."""


@dataclass(frozen=True)
class OneFrame(Recording):
    """A recording that repeats one frame, read once."""

    frame: Frame

    def frames(self) -> Iterator[Frame]:
        """Yields the frame."""
        for _ in range(self.length):
            yield self.frame

    def truth(self) -> None:
        """Returns None."""


class Stub(Registrar):
    """A registrar that returns its start."""

    def __init__(self, registrar: Registrar) -> None:
        self.body, self.primitives = registrar.body, registrar.primitives

    def register(
        self,
        observation: Observation,
        candidates: Sequence[Pose],
        *,
        prior: Prior | None = None,
        warm_start: RegistrationResult | None = None,
    ) -> RegistrationResult:
        """Returns the first candidate."""
        return RegistrationResult(candidates[0], 0.0, 1.0, True, 0, 0, "stub")

    def evaluate(self, observation: Observation, pose: Pose) -> Evaluation:
        """Returns an inlier probability of 1 for all points."""
        return Evaluation(0.0, np.ones(len(observation.points)))


def megabytes() -> float:
    """Returns the peak memory of this process [MB]."""
    return resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / 1024.0


def undisturbed(seconds: np.ndarray) -> float:
    """Returns a low percentile of the times per frame [ms], to exclude other processes' load."""
    return 1000.0 * float(np.percentile(seconds, 10.0))


def tracked(name: str) -> dict[str, float]:
    """Tracks one of the two recordings in this process."""
    walk = regkit.load_recording(WALK)
    template = regkit.load_template("human", height=1.63)
    voxels = {"voxel": 0.03, "sigma": 0.01}
    preprocessor = Preprocessor.parse({"kind": "points", **voxels}, place=name, field="data")
    method = Method.parse("best", place=name, field="method")
    recording: Recording = Repeated(walk.name, walk.fps, FRAMES, recording=walk)
    if name == "stub":
        recording = OneFrame(walk.name, walk.fps, MANY, frame=next(walk.frames()))
    session = _session(recording, template, preprocessor)
    start = session.begin()
    registrar = method.bind(start.body)
    tracker = method.tracker
    if name == "stub":
        registrar = Stub(registrar)
        tracker = Tracker.parse("constant_pose", place=name, field="tracker")
    assert tracker is not None
    recorder = TrackRecorder(registrar, session.recording.fps, session.observation)
    ends = np.zeros(recording.length + 1)
    before = megabytes()
    with one_thread():
        ends[0] = time.process_time()
        for index, frame in enumerate(session.tracked(registrar, tracker, start.pose)):
            recorder.add(frame)
            ends[index + 1] = time.process_time()
    tenth = recording.length // 10
    seconds = np.diff(ends)
    return {
        "frames": len(recorder.track()),
        "memory_before_mb": round(before, 1),
        "peak_memory_mb": round(megabytes(), 1),
        "first_tenth_ms": round(undisturbed(seconds[:tenth]), 3),
        "last_tenth_ms": round(undisturbed(seconds[-tenth:]), 3),
    }


def _session(recording: Recording, template: Template, preprocessor: Preprocessor) -> Session:
    start = StartSearch.parse({"kind": "given", **START}, place="streams", field="start")
    return Session(recording, template, preprocessor, start)


def main() -> None:
    """Prints the figures of both, each measured in a process of its own."""
    figures = {}
    print("| | frames | peak [MB] | before tracking [MB] | first tenth [ms/frame] | last tenth |")
    print("|---|--:|--:|--:|--:|--:|")
    for name in ("walk", "stub"):
        command = [sys.executable, __file__, name]
        told = subprocess.run(command, check=True, stdout=subprocess.PIPE, text=True).stdout
        one = json.loads(told.splitlines()[-1])
        one["growth"] = round(one["last_tenth_ms"] / one["first_tenth_ms"], 3)
        figures[name] = one
        print(
            f"| {name} | {one['frames']} | {one['peak_memory_mb']} | {one['memory_before_mb']} | "
            f"{one['first_tenth_ms']} | {one['last_tenth_ms']} |"
        )
        sys.stdout.flush()
    print(json.dumps({"threads": 1, **figures}))


if __name__ == "__main__":
    if len(sys.argv) > 1:
        print(json.dumps(tracked(sys.argv[1])))
    else:
        main()
