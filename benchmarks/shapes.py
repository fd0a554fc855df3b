"""Comparison of Gaussians, spheres and meshes on equal data, starts and trackers.

    python benchmarks/shapes.py [UTD_MHAD]

Errors are means over the suite's 13 recordings of people and 6 of hands, with templates of the true
lengths; over the six recordings of the small body with the average template, whose shape differs;
and, if its folder is given, over 14 real Kinect recordings of UTD-MHAD. Frames per second are
measured on the sample walk and hand, in alternation on one thread.
"""

from __future__ import annotations

import sys
from importlib.metadata import entry_points
from pathlib import Path

from _suite import HEADER, last_line, row, tracked, tracked_utd
from tracking import ROUNDS, Bench

from regkit.metrics import Measure
from regkit.system.optional import one_blas_thread

METHODS = {
    "SoG": "{preset: best, shape: {kind: sog, surface: visible}}",
    "G-SoG": "{preset: best}",
    "spheres": "{preset: spheres}",
    "mesh, point to point": "{preset: icp, kernel: {kind: point_to_point, reverse_weight: 0.5}}",
    "mesh, point to plane": "{preset: icp}",
    "mesh, point to plane, textbook": (
        "{preset: icp, kernel: {matches: fixed}, annealing: [0.0, 0.0, 0.0]}"
    ),
    "G-SoG, without free_space": "{preset: best, terms: [visibility, intersection, continuity]}",
    "mesh, point to plane, without free_space": "{preset: icp, terms: [continuity]}",
}


def installed() -> dict[str, str]:
    """Returns the methods whose presets are installed."""
    presets = entry_points(group="regkit.methods.presets").names
    return {name: text for name, text in METHODS.items() if _preset(text) in presets}


def _preset(text: str) -> str:
    return text.removeprefix("{preset: ").split(",")[0].rstrip("}")


def speeds(methods: dict[str, str]) -> dict[str, dict[str, float]]:
    """Returns frames per second on the sample recordings, and their ratio to G-SoG."""
    figures: dict[str, dict[str, float]] = {}
    print("\n| method | walk [fps] | of G-SoG | hand [fps] | of G-SoG |\n|---|--:|--:|--:|--:|")
    with one_blas_thread():
        for body, example in (("walk", "demo.yaml"), ("hand", "hand.yaml")):
            benches = {name: Bench(example, text) for name, text in methods.items()}
            # Methods alternate, so that other load on the machine affects all of them equally.
            rounds = [
                {name: bench.round() for name, bench in benches.items()} for _ in range(ROUNDS)
            ]
            for name, bench in benches.items():
                fps = len(bench.frames) / min(own[name] for own in rounds)
                figures.setdefault(name, {})[body] = fps
    for name, own in figures.items():
        cells = [f"{fps:.0f} | {fps / figures['G-SoG'][body]:.2f}" for body, fps in own.items()]
        print(f"| {name} | {' | '.join(cells)} |")
    return figures


def print_each(measures: dict[str, dict[str, Measure]]) -> None:
    """Prints the errors of every method on every recording."""
    print("\n| raw / adjusted [cm] | " + " | ".join(measures) + " |")
    print("|---|" + "--:|" * len(measures))
    for name in next(iter(measures.values())):
        cells = [
            f"{own[name].joint_error_raw_cm:.2f} / {own[name].joint_error_adjusted_cm:.2f}"
            for own in measures.values()
        ]
        print(f"| {name} | {' | '.join(cells)} |")


def main() -> None:
    """Prints the tables, and their figures as one JSON object in the last line."""
    methods = installed()
    figures: dict[str, object] = {"speed": speeds(methods)}
    parts: dict[str, str | None] = {"human": None, "hand": None, "human_small": "human"}
    for kind, template in parts.items():
        what = kind if template is None else f"{kind} with the average person's template"
        print(f"\n{what}\n\n{HEADER}")
        measures = {name: tracked(kind, text, template=template) for name, text in methods.items()}
        figures[what] = {name: row(name, measure) for name, measure in measures.items()}
        print_each(measures)
    if len(sys.argv) > 1:
        print(f"\nUTD-MHAD\n\n{HEADER}")
        figures["utd"] = {
            name: row(name, tracked_utd(Path(sys.argv[1]), text)) for name, text in methods.items()
        }
    last_line(figures)


if __name__ == "__main__":
    main()
