"""Violations of joint limits by each solver, and agreement of the solvers without limits.

    python benchmarks/limits.py [POSES]

The data are points drawn from the Gaussians of a person and a hand in random poses, many of them
beyond the limits. Starting from a disturbed pose within the limits, every solver minimizes the
energy (kernel `likelihood`, G-SoG, no other term). One in twenty problems is also solved to
convergence without limits, where all solvers should reach the same energy. One thread; about ten
minutes.
"""

from __future__ import annotations

import json
import sys
import time
from collections.abc import Iterator
from dataclasses import replace
from typing import Any

import numpy as np
from rich.console import Console
from rich.progress import track
from rich.table import Table

from regkit.body import Body
from regkit.interfaces import Method, RegistrationResult, ShapeModel, Template
from regkit.observation import Observation
from regkit.skeleton import Pose
from regkit.system.optional import one_blas_thread

SIZES = {"human": 1.75, "hand": 0.186}
POINTS = 300

LIMITED: dict[str, dict[str, Any]] = {
    "ipopt": {"solver": {"kind": "ipopt"}},
    "gauss_newton": {"solver": {"kind": "gauss_newton", "max_iterations": 100}},
    "lbfgs": {"solver": {"kind": "lbfgs"}},
    "lbfgs, term limits": {"solver": {"kind": "lbfgs"}, "terms": ["limits"]},
}

PRECISE: dict[str, dict[str, Any]] = {
    "ipopt": {"max_iterations": 1000, "value_tolerance": 0.0, "reach": 10.0},
    "gauss_newton": {"max_iterations": 3000, "value_tolerance": 1e-13, "resting": 0.0},
    "lbfgs": {"max_iterations": 5000, "value_tolerance": 1e-15, "gradient_tolerance": 1e-9},
}

FURTHER = {"solver": {"kind": "gauss_newton", **PRECISE["gauss_newton"]}}


def problems(body: Body, count: int) -> Iterator[tuple[Observation, Pose]]:
    """Yields data of random poses, with a start within the limits for each."""
    random = np.random.default_rng(0)
    bones = body.skeleton
    gaussians = ShapeModel.load("gsog")().bind(body)
    root = np.eye(4)
    root[2, 3] = 2.0
    joints = np.arange(bones.dofs) >= bones.ball_dofs.start
    for _ in range(count):
        step = random.uniform(0.2, 1.0) * joints * random.normal(size=bones.dofs)
        target = bones.retract(bones.rest(root), step)
        placed = gaussians.place(body.place(target).transforms)
        chosen = random.integers(len(gaussians), size=POINTS)
        spread = gaussians.scales[chosen] * random.normal(size=(POINTS, 3))
        points = placed.centres[chosen] + np.einsum("nij,nj->ni", placed.axes[chosen], spread)
        data = Observation(points, np.ones(POINTS), np.full(POINTS, (0.005 * body.size) ** 2))
        disturbed = bones.retract(target, 0.1 * joints * random.normal(size=bones.dofs))
        yield data, bones.limits.projected(disturbed)


def unlimited(body: Body) -> Body:
    """Returns the same body without limits."""
    limits = body.skeleton.limits
    free = replace(
        limits,
        hinge=np.broadcast_to([-np.inf, np.inf], limits.hinge.shape),
        twist=np.broadcast_to([-np.inf, np.inf], limits.twist.shape),
        swing=np.full_like(limits.swing, np.inf),
    )
    return replace(body, skeleton=replace(body.skeleton, limits=free))


def solved(
    body: Body, given: list[tuple[Observation, Pose]], title: str, options: dict[str, Any]
) -> tuple[list[RegistrationResult], list[float]]:
    """Returns the results of a method on all problems, and their times [s]."""
    method = Method.load("direct").model_validate(
        {"kind": "direct", "shape": "gsog", "kernel": "likelihood", **options}
    )
    registrar = method.bind(body)
    found, seconds = [], []
    console = Console(stderr=True)
    for data, start in track(given, title, console=console, disable=not console.is_terminal):
        begun = time.perf_counter()
        found.append(registrar.register(data, [start]))
        seconds.append(time.perf_counter() - begun)
    return found, seconds


def limited_table(body: Body, given: list[tuple[Observation, Pose]]) -> dict[str, Any]:
    """Returns the figures of every solver with limits: largest violation, energy, time."""
    columns = ("worst [rad]", "beyond 1e-6 rad [%]", "energy", "converged [%]", "median [ms]")
    table = Table("solver", *columns, title=f"{body.name}, {len(given)} poses")
    plain = Method.load("direct")(shape="gsog", kernel="likelihood", solver="lbfgs").bind(body)
    figures = {}
    for name, options in LIMITED.items():
        found, seconds = solved(body, given, f"{body.name}: {name}", options)
        worst = np.array([body.skeleton.limits.violation(one.pose).max() for one in found])
        # The energy excludes the term's.
        energies = [
            plain.evaluate(data, one.pose).energy
            for (data, _), one in zip(given, found, strict=True)
        ]
        values = (
            float(worst.max()),
            100.0 * float((worst > 1e-6).mean()),
            float(np.mean(energies)),
            100.0 * float(np.mean([one.converged for one in found])),
            1000.0 * float(np.median(seconds)),
        )
        table.add_row(name, *(f"{value:.3g}" for value in values))
        figures[name] = dict(zip(columns, (float(f"{v:.4g}") for v in values), strict=True))
    Console().print(table)
    return figures


def agreement_table(body: Body, given: list[tuple[Observation, Pose]]) -> dict[str, Any]:
    """Returns the distance of every solver's energy without limits to the lowest one found.

    Gauss-Newton continues from higher energies: those that it cannot reduce are minima too.
    """
    columns = ("within 1e-6 [%]", "median difference", "largest", "other minima [%]", "median [ms]")
    title = f"{body.name} without limits, {len(given)} poses: energy relative to the lowest"
    table = Table("solver", *columns, title=title)
    outcomes = {
        kind: solved(body, given, f"{body.name}: {kind}", {"solver": {"kind": kind, **options}})
        for kind, options in PRECISE.items()
    }
    energies = np.array([[one.energy for one in found] for found, _ in outcomes.values()])
    differences = (energies - energies.min(axis=0)) / np.abs(energies.min(axis=0))
    figures = {}
    for (kind, (found, seconds)), own in zip(outcomes.items(), differences, strict=True):
        others = [index for index in range(len(given)) if own[index] >= 1e-6]
        again = [(given[index][0], found[index].pose) for index in others]
        further, _ = solved(body, again, f"{body.name}: continued from {kind}", FURTHER)
        kept = [
            found[index].energy - one.energy < 1e-6 * abs(one.energy)
            for index, one in zip(others, further, strict=True)
        ]
        values = (
            100.0 * float((own < 1e-6).mean()),
            float(np.median(own)),
            float(own.max()),
            100.0 * sum(kept) / len(given),
            1000.0 * float(np.median(seconds)),
        )
        table.add_row(kind, *(f"{value:.3g}" for value in values))
        figures[kind] = dict(zip(columns, (float(f"{v:.4g}") for v in values), strict=True))
    agreed = 100.0 * float((differences.max(axis=0) < 1e-6).mean())
    Console().print(table, f"All agree to 1e-6 in {agreed:.0f} %.")
    return figures | {"all agree [%]": agreed}


def main() -> None:
    """Prints the tables, and their figures as one JSON object in the last line."""
    count = int(sys.argv[1]) if len(sys.argv) > 1 else 1000
    figures: dict[str, Any] = {"threads": 1, "poses": count}
    with one_blas_thread():
        for kind, size in SIZES.items():
            body = Template.load(kind)().body(size)
            given = list(problems(body, count))
            figures[kind] = limited_table(body, given)
            some = given[: max(1, count // 20)]
            figures[f"{kind} without limits"] = agreement_table(unlimited(body), some)
    print(json.dumps(figures))


if __name__ == "__main__":
    main()
