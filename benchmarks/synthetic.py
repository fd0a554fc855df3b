"""Accuracy of tracking people and hands on synthetic recordings with exact truth.

    python benchmarks/synthetic.py

13 recordings of two bodies and 6 of two hands (the presets ``people`` and ``hands``: other motions,
views, noise and speeds than the samples), templates with the true lengths, starts found in each
first frame. One thread per process.
"""

from __future__ import annotations

from _suite import HEADER, last_line, row, tracked

METHODS = {
    "correlation, G-SoG, no terms": (
        "{kind: direct, shape: gsog, kernel: {kind: correlation, covariance: frozen}, "
        "solver: lbfgs, coordinates: quaternion}"
    ),
    "paper, SoG": "{preset: paper, shape: sog}",
    "paper, G-SoG": "{preset: paper}",
    "best": "{preset: best}",
}


def main() -> None:
    """Prints the tables, and their figures as one JSON object in the last line."""
    figures: dict[str, object] = {}
    for kind in ("human", "hand"):
        print(f"\n{kind}\n\n{HEADER}")
        measures = {name: tracked(kind, method) for name, method in METHODS.items()}
        figures[kind] = {name: row(name, measure) for name, measure in measures.items()}
        print(f"\n| {kind}, raw / adjusted [cm] | " + " | ".join(measures) + " |")
        print("|---|" + "--:|" * len(measures))
        for name in measures["best"]:
            cells = [
                f"{m[name].joint_error_raw_cm:.1f} / {m[name].joint_error_adjusted_cm:.1f}"
                for m in measures.values()
            ]
            print(f"| {name.replace('_', ' ', 1)} | " + " | ".join(cells) + " |")
    last_line(figures)


if __name__ == "__main__":
    main()
