"""Time per frame with each solver, and the fraction spent on evaluations.

    python benchmarks/solvers.py

The method `best` tracks the sample walk (176x144 pixels, G-SoG of 13 Gaussians) with each solver,
three times; the fastest run counts. Preprocessing and the start are excluded. One thread.
"""

from __future__ import annotations

import json
import time
from pathlib import Path
from typing import Any
from unittest.mock import patch

import numpy as np
from rich.console import Console
from rich.table import Table

from regkit.body import Body
from regkit.experiment import Experiment
from regkit.interfaces import Method, Past, RegistrationResult, Solver
from regkit.observation import Observation
from regkit.registration import RegistrationProblem
from regkit.skeleton import Pose
from regkit.system.optional import one_blas_thread
from regkit_plugins.starts.exemplars import Exemplars

DEMO = Path(__file__).parent.parent / "docs" / "examples" / "demo.yaml"

TRACKED: dict[str, dict[str, Any]] = {
    "gauss_newton": {"kind": "gauss_newton", "max_iterations": 6, "value_tolerance": 0.03},
    "ipopt": {"kind": "ipopt", "value_tolerance": 0.03},
    "ipopt, tolerance 1e-5": {"kind": "ipopt"},
    "lbfgs": {"kind": "lbfgs"},
}


def tracking_table() -> dict[str, Any]:
    """Prints time and evaluations per frame of `best` on the sample walk with each solver."""
    columns = ("ms per frame", "of that evaluation", "ratio", "evaluations", "energy")
    table = Table("solver", *columns, title="sample walk, best, G-SoG")
    experiment = Experiment.read(DEMO)
    (recording,) = experiment.dataset.chosen()
    data = [experiment.preprocessor.preprocess(frame) for frame in recording.frames()]
    start = Exemplars().find(experiment.template, [data[0]])
    figures: dict[str, Any] = {}
    for name, options in TRACKED.items():
        solver = Solver.load(options["kind"]).model_validate(options)
        method = experiment.methods["best"].model_copy(update={"solver": solver})
        rounds = [tracked(method, start.body, start.pose, data) for _ in range(3)]
        found, seconds, evaluating = min(rounds, key=lambda one: one[1])
        each = 1000.0 * seconds / len(data)
        first = figures.get("gauss_newton", {"ms per frame": each})
        values = (
            each,
            1000.0 * evaluating / len(data),
            each / first["ms per frame"],
            float(np.mean([one.evaluations for one in found])),
            float(np.mean([one.energy for one in found])),
        )
        table.add_row(name, *(f"{value:.4g}" for value in values))
        figures[name] = dict(zip(columns, (float(f"{v:.4g}") for v in values), strict=True))
    Console().print(table)
    return figures


def tracked(
    method: Method, body: Body, start: Pose, data: list[Observation]
) -> tuple[list[RegistrationResult], float, float]:
    """Returns a track, its time, and the time of its evaluations [s]."""
    assert method.tracker is not None
    follower = method.tracker.bind(method.bind(body))
    evaluating = 0.0

    def timed(function: Any) -> Any:
        def call(problem: RegistrationProblem, x: Any) -> Any:
            nonlocal evaluating
            begun = time.perf_counter()
            result = function(problem, x)
            evaluating += time.perf_counter() - begun
            return result

        return call

    looked_at = {
        name: timed(getattr(RegistrationProblem, name))
        for name in ("normal_equations", "value_and_gradient")
    }
    with patch.multiple(RegistrationProblem, **looked_at):
        past, found = Past.start(start), []
        begun = time.perf_counter()
        for observation in data:
            found.append(follower.step(observation, past))
            past = past.followed_by(found[-1])
        return found, time.perf_counter() - begun, evaluating


def main() -> None:
    """Prints the table, and its figures as one JSON object in the last line."""
    with one_blas_thread():
        figures = tracking_table()
    print(json.dumps({"threads": 1, **figures}))


if __name__ == "__main__":
    main()
