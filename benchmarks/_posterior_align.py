"""Coverage of the intervals of rigid alignments, on pairs of bunnies with a known pose."""

from __future__ import annotations

from pathlib import Path

import numpy as np
from _rigid_pairs import Pair, bunny

from regkit.alignment import Alignment, align
from regkit.cli.choices import method_named
from regkit.clouds import read_cloud
from regkit.geometry.rigid import transformed
from regkit.geometry.rotation import from_matrix, to_vector
from regkit.metrics.joints import HALF_WIDTH
from regkit.system.arrays import Array

BUNNY = Path(__file__).parents[2] / "shared" / "data" / "rigid_misc" / "bunny_source.txt"
SEEDS, ANGLES = 10, (10, 30, 60, 90)
WITHIN_DEG, WITHIN_SIZE = 5.0, 0.05
CONDITIONS: dict[str, dict[str, float]] = {
    "clean": {},
    "noise": {"noise": 0.01},
    "overlap": {"overlap": 0.6},
    "outliers": {"outliers": 0.3},
    "all": {"noise": 0.01, "overlap": 0.6, "outliers": 0.3},
}


def alignment_coverage() -> dict[str, float]:
    """Prints the table of the conditions; returns the percentages that the intervals hold."""
    points, method = read_cloud(BUNNY), method_named("rigid")
    print("\n| bunny pairs | held [%] | held of the aligned [%] | aligned | deviation [deg] |")
    print("|---|" + "--:|" * 4)
    held, aligned = [], []
    for condition, values in CONDITIONS.items():
        own, well, turns = [], [], []
        for angle in ANGLES:
            for seed in range(SEEDS):
                pair = bunny(points, angle, seed, **values)
                found = align(pair.source, pair.target, method, voxel=0.0, start="centroids")
                turn, shift = pair.errors(found.transform)
                own.append(np.abs(_error(pair, found)) <= HALF_WIDTH * found.deviations)
                well.append(turn < WITHIN_DEG and shift < WITHIN_SIZE)
                turns.append(np.degrees(found.deviations[3:].mean()))
        good = np.array(own)[well]
        print(
            f"| {condition} | {100 * np.mean(own):.1f} | {100 * good.mean():.1f} | {sum(well)} of "
            f"{len(well)} | {np.median(turns):.2f} |",
            flush=True,
        )
        held += own
        aligned += well
    good = np.array(held)[aligned]
    figures = {"all": float(np.mean(held)), "aligned": float(good.mean())}
    print(f"| together | {100 * figures['all']:.1f} | {100 * figures['aligned']:.1f} | "
          f"{sum(aligned)} of {len(aligned)} | |")  # fmt: skip
    return {name: round(100.0 * value, 1) for name, value in figures.items()}


def _error(pair: Pair, found: Alignment) -> Array:
    """Returns the twist from the found to the true alignment, (6,), about the source's centroid."""
    centre = pair.source.mean(axis=0, keepdims=True)
    shift = transformed(pair.truth, centre) - transformed(found.transform, centre)
    turn = to_vector(from_matrix(pair.truth[:3, :3] @ found.transform[:3, :3].T))
    return np.concatenate([shift[0], turn])
