"""Comparison of sphere-meshes with sums of Gaussians: accuracy on the suite, and speed.

    python benchmarks/spheres.py

The preset ``spheres`` with one change at a time, and ``best``; every method has the same start,
tracker and solver. Frames per second are measured on the sample walk and hand, in one process, as
the fastest of several rounds, and given relative to ``best``.
"""

from __future__ import annotations

from _suite import HEADER, last_line, row, tracked
from tracking import Bench

from regkit.system.optional import one_blas_thread

CONTINUITY = "{kind: continuity, weight: 0.003}"
METHODS = {
    "best, G-SoG": "{preset: best}",
    "best, SoG": "{preset: best, shape: {kind: sog, surface: visible}}",
    "**spheres**": "{preset: spheres}",
    "spheres alone, 1 radius apart": "{preset: spheres, shape: {variant: spheres}}",
    "spheres alone, 0.5 radii apart": "{preset: spheres, shape: {variant: spheres, spacing: 0.5}}",
    "whole side": "{preset: spheres, kernel: {side: whole}}",
    "squares": "{preset: spheres, kernel: {robust: {loss: squares}}}",
    "Huber": "{preset: spheres, kernel: {robust: {loss: huber}}}",
    "Tukey": "{preset: spheres, kernel: {robust: {loss: tukey}}}",
    "scale 1 cm (hand: 3 mm)": "{preset: spheres, kernel: {robust: {scale: SCALE}}}",
    "scale 2 cm (hand: 6 mm)": "{preset: spheres, kernel: {robust: {scale: TWICE}}}",
    "with visibility": f"{{preset: spheres, terms: [visibility, intersection, {CONTINUITY}]}}",
    "with free_space": f"{{preset: spheres, terms: [free_space, intersection, {CONTINUITY}]}}",
    "without intersection": f"{{preset: spheres, terms: [{CONTINUITY}]}}",
    "continuity 0.01": "{preset: spheres, terms: [intersection, continuity]}",
    "without any term": "{preset: spheres, terms: []}",
    "without recovery": "{preset: spheres, tracker: {recovery: null}}",
    "10 iterations": "{preset: spheres, solver: {max_iterations: 10}}",
}
SCALES = {"human": ("0.01", "0.02"), "hand": ("0.003", "0.006")}
TURNS = 4
SPEED = ("best, G-SoG", "best, SoG", "**spheres**", "spheres alone, 1 radius apart")


def main() -> None:
    """Prints the tables, and their figures as one JSON object in the last line."""
    figures: dict[str, object] = {"threads": 1}
    for kind, example in (("human", "demo.yaml"), ("hand", "hand.yaml")):
        print(f"\n{HEADER.replace('method', kind)}")
        figures[kind] = {
            name: row(name, tracked(kind, _scaled(method, kind)))
            for name, method in METHODS.items()
        }
        print(f"\n| {kind}, shipped | frames per second | of best |\n|---|--:|--:|")
        speeds = _frames_per_second(example)
        for name, speed in speeds.items():
            print(f"| {name} | {speed:.0f} | {speed / speeds[SPEED[0]]:.2f} |")
        figures[f"{kind}_fps"] = {name: round(speed, 1) for name, speed in speeds.items()}
    last_line(figures)


def _scaled(method: str, kind: str) -> str:
    once, twice = SCALES[kind]
    return method.replace("SCALE", once).replace("TWICE", twice)


def _frames_per_second(example: str) -> dict[str, float]:
    """Returns frames per second of each method, in alternation to share other load equally."""
    with one_blas_thread():
        benches = {name: Bench(example, METHODS[name]) for name in SPEED}
        seconds = dict.fromkeys(SPEED, float("inf"))
        for _ in range(TURNS):
            for name, bench in benches.items():
                seconds[name] = min(seconds[name], bench.seconds())
        return {name: len(bench.frames) / seconds[name] for name, bench in benches.items()}


if __name__ == "__main__":
    main()
