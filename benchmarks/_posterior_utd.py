"""Real recordings, UTD-MHAD, by the method of each frame alone, by the filter, and smoothed."""

from __future__ import annotations

from pathlib import Path
from tempfile import TemporaryDirectory

from _suite import UTD

from regkit.experiment import Experiment, run

WAYS = {
    "best": ("best", "null"),
    "filtered": ("filtered", "null"),
    "smoothed": ("filtered", "smooth"),
}
"""Preset and refinement of each way."""


def utd(folder: Path) -> dict[str, dict[str, float]]:
    """Prints the joint errors on the recordings in a folder, and returns their means."""
    print("\n| UTD-MHAD | raw [cm] | adjusted [cm] | held [%] | largest increase of raw [cm] |")
    print("|---|" + "--:|" * 4)
    figures: dict[str, dict[str, float]] = {}
    base: dict[str, float] = {}
    for way, (preset, refine) in WAYS.items():
        with TemporaryDirectory() as temporary:
            settings = (
                f"dataset.root={folder.absolute()}",
                f"methods={{method: {{preset: {preset}}}}}",
                f"refine={refine}",
            )
            experiment = Experiment.read(UTD, settings)
            measures = run(experiment, Path(temporary) / "out", figures=False).measures["method"]
        raw = {name: one.joint_error_raw_cm or 0.0 for name, one in measures.items()}
        base = base or raw
        count = len(measures)
        row = {
            "raw_cm": sum(raw.values()) / count,
            "adjusted_cm": sum(one.joint_error_adjusted_cm or 0.0 for one in measures.values())
            / count,
            "held_percent": sum(one.interval_coverage_percent or 0.0 for one in measures.values())
            / count,
            "largest_increase_cm": max(raw[name] - base[name] for name in base),
        }
        figures[way] = {name: round(value, 2) for name, value in row.items()}
        print(
            f"| {way} | " + " | ".join(f"{value:.2f}" for value in row.values()) + " |", flush=True
        )
    return figures
