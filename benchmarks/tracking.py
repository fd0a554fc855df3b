"""Frames per second from depth image to pose, and the time by parts.

    python benchmarks/tracking.py

The sample walk (176x144 pixels, G-SoG of 13 Gaussians) and the sample hand (18 Gaussians) with the
method ``best``, and the walk with ``spheres``, on one thread: back-projection, preprocessing,
registration and tracking; the start is excluded. Every recording is tracked several times, and the
fastest run counts, to exclude interference. A frame is also compared with ``numpy.exp`` of as many
numbers as it has pairs of Gaussians and points in five evaluations: 13 x 900 x 5.
"""

from __future__ import annotations

import cProfile
import json
import pstats
import resource
import time
from collections.abc import Iterator
from pathlib import Path

import numpy as np

from regkit.experiment import Experiment
from regkit.interfaces import BoundTracker, Past, RegistrationResult
from regkit.observation import Frame
from regkit.system.optional import one_blas_thread
from regkit_plugins.starts.exemplars import Exemplars

EXAMPLES = Path(__file__).parent.parent / "docs" / "examples"
ROUNDS = 5
BENCHES = (
    ("human", "demo.yaml", "best"),
    ("hand", "hand.yaml", "best"),
    ("human", "demo.yaml", "spheres"),
)
"""Names, examples and methods."""
PARTS = {
    "solvers/gauss_newton/compiled": "compiled registration",
    "compiled_plan": "binding, candidates, inliers",
    "preprocessors": "observing",
    "observation": "observing",
    "geometry": "observing",
    "clouds": "observing",
    "search": "search of limbs",
    "trackers": "tracker",
    "interfaces": "tracker",
    "skeleton": "tracker",
    "registration": "calls around them",
    "methods": "calls around them",
    "system": "calls around them",
}
"""Part of regkit by a part of a file's path; NumPy's time counts for its callers."""


class Bench:
    """One example with one method, given as in YAML."""

    def __init__(self, example: str, method_text: str = "{preset: best}") -> None:
        experiment = Experiment.read(EXAMPLES / example, [f"methods={{method: {method_text}}}"])
        (recording,) = experiment.dataset.chosen()
        method = experiment.methods["method"]
        self.frames = list(recording.frames())
        self.preprocessor = experiment.preprocessor
        start = Exemplars().find(
            experiment.template, [self.preprocessor.preprocess(self.frames[0])]
        )
        self.start = Past.start(start.pose)
        self.follower: BoundTracker = (method.tracker or experiment.tracker).bind(
            method.bind(start.body)
        )

    def track(self) -> Iterator[RegistrationResult]:
        """Tracks the recording once, from the depth images on."""
        past = self.start
        for frame in self.frames:
            assert frame.camera is not None
            assert frame.depth is not None
            points = frame.camera.back_projected(frame.depth)
            seen = Frame(points, frame.camera, frame.depth, frame.place)
            found = self.follower.step(self.preprocessor.preprocess(seen), past)
            past = past.followed_by(found)
            yield found

    def seconds(self) -> float:
        """Returns the lowest time for the recording over several rounds."""
        return min(self.round() for _ in range(ROUNDS))

    def round(self) -> float:
        """Returns the time for the recording."""
        begun = time.perf_counter()
        evaluations = [found.evaluations for found in self.track()]
        ended = time.perf_counter()
        self.evaluations = sum(evaluations) / len(evaluations)
        return ended - begun

    def shares(self) -> dict[str, float]:
        """Returns the percentage of the time in each part of regkit, under a profiler."""
        profile = cProfile.Profile()
        profile.enable()
        for _ in self.track():
            pass
        profile.disable()
        stats = pstats.Stats(profile)
        shares: dict[str, float] = {}
        total = stats.total_tt
        for (file, _, _), (_, _, own, _, callers) in stats.stats.items():
            if (part := part_of(file)) is not None:
                shares[part] = shares.get(part, 0.0) + own
                continue
            for (caller, _, _), (*_, through, _) in callers.items():
                part = part_of(caller) or "other"
                shares[part] = shares.get(part, 0.0) + through
        return {part: 100.0 * own / total for part, own in sorted(shares.items())}


def exponentials() -> float:
    """Returns the time of ``numpy.exp`` of 13 x 900 x 5 numbers [s], the lowest of several."""
    numbers = -np.random.default_rng(0).uniform(0.0, 50.0, (13, 900, 5))
    rounds = []
    for _ in range(20 * ROUNDS):
        begun = time.perf_counter()
        np.exp(numbers)
        rounds.append(time.perf_counter() - begun)
    return min(rounds)


def part_of(file: str) -> str | None:
    """Returns the part of regkit of a file."""
    if "regkit" not in file:
        return None
    return next((name for part, name in PARTS.items() if part in file), "other")


def main() -> None:
    """Prints the tables, and their figures as one JSON object in the last line."""
    figures: dict[str, object] = {"threads": 1}
    with one_blas_thread():
        exp = exponentials()
        for name, example, method in BENCHES:
            bench = Bench(example, f"{{preset: {method}}}")
            seconds = bench.seconds()
            fps = len(bench.frames) / seconds
            print(
                f"{name}, {method}: {fps:.0f} frames per second, {1000 / fps:.2f} ms each, "
                f"{bench.evaluations:.1f} evaluations"
            )
            for part, share in bench.shares().items():
                print(f"  {part:30s} {share:5.1f} %")
            figures[f"{name}_{method}_fps"] = round(fps, 1)
            figures[f"{name}_{method}_frame_over_exp"] = round(1.0 / fps / exp, 1)
    figures["human_frame_over_exp"] = figures.pop("human_best_frame_over_exp")
    memory = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / 1024
    print(f"peak memory: {memory:.0f} MB")
    print(json.dumps(figures | {"memory_mb": round(memory)}))


if __name__ == "__main__":
    main()
