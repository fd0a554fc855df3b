"""How sure a pose is: coverage of the intervals, the filter and the smoother.

    python benchmarks/posterior.py [--utd FOLDER]

The 13 recordings of ``people``, the 28 of ``smmc_like`` and the 6 of ``hands``, with templates of
the true lengths, are tracked by ``best`` and by ``filtered`` from the same starts, and the latter
is smoothed. A joint is hidden in a frame if its segment has little data of its own, else visible;
it is unmeasured if no data are near the true joint, as also inside of a trunk. An interval is that
of one coordinate of a joint, 1.64 standard deviations to both sides of the marker; it has to hold
the joint's coordinate after subtraction of the marker's constant displacement. Then 200 pairs of
bunnies are aligned as in ``benchmarks/rigid.py``, with intervals of the six components of the
error's twist. ``people`` follows once more as 1, 2 and 4 cameras see it, as in
``benchmarks/views.py``. With ``--utd``, the recordings of UTD-MHAD in a folder are tracked in the
same ways.
"""

from __future__ import annotations

import argparse
from collections.abc import Sequence
from pathlib import Path
from typing import Any

import numpy as np
import views
from _posterior_align import alignment_coverage
from _posterior_tracks import SUITES, Compared, Tracked, compared
from _posterior_utd import utd
from _suite import last_line

from regkit.system.optional import one_blas_thread

WALK = "average_walk_oblique"
ARM = ("left_elbow", "left_wrist", "left_hand")
"""The recording whose left arm is hidden at its end, and the arm's joints."""


def main() -> None:
    """Prints the tables, and their figures as one JSON object in the last line."""
    parser = argparse.ArgumentParser()
    parser.add_argument("--utd", type=Path, help="folder of UTD-MHAD")
    folder = parser.parse_args().utd
    figures: dict[str, Any] = {}
    with one_blas_thread():
        rows = [row for suite in SUITES for row in suite_table(suite)]
        figures |= coverage(rows)
        figures["coverage_align_percent"] = alignment_coverage()
        figures |= motion(rows)
        each = views.accuracy(set())
        figures["views"] = {cameras: found["raw_cm"] for cameras, found in each.items()}
        if folder is not None:
            figures["utd"] = utd(folder)
    last_line(figures)


def suite_table(suite: str) -> list[Compared]:
    """Prints a row for each recording of a suite, and returns them."""
    print(
        f"\n| {suite} | best [cm] | filtered | smoothed | jitter best [mm] | filtered | smoothed |"
    )
    print("|---|" + "--:|" * 6)
    rows = []
    for row in compared(suite):
        kinds = (row.best, row.filtered, row.smoothed)
        raw = " | ".join(f"{kind.raw:.2f}" for kind in kinds)
        jitter = " | ".join(f"{1000.0 * kind.jitter:.1f}" for kind in kinds)
        print(f"| {row.name} | {raw} | {jitter} |", flush=True)
        rows.append(row)
    return rows


GROUPS = ("visible", "hidden", "unmeasured")


def coverage(rows: Sequence[Compared]) -> dict[str, Any]:
    """Prints the coverage of the intervals in the groups of joints; returns that of the filter."""
    heads = [f"{group} [{unit}]" for unit in ("%", "mm") for group in GROUPS]
    print(f"\n| 90 % intervals of | suite | {' | '.join(heads)} |")
    print("|---|---|" + "--:|" * len(heads))
    figures: dict[str, Any] = {}
    for way in ("best", "filtered", "smoothed"):
        for suite in (*SUITES, "all"):
            own = [getattr(row, way) for row in rows if suite in (row.suite, "all")]
            covered = {group: _covered(own, group) for group in GROUPS}
            held = [f"{covered[group][0]:.1f}" for group in GROUPS]
            wide = [f"{covered[group][1]:.1f}" for group in GROUPS]
            print(f"| {way} | {suite} | {' | '.join([*held, *wide])} |")
            for group, (share, _) in covered.items() if way == "filtered" else ():
                figures.setdefault(f"coverage_{group}_percent", {})[suite] = round(share, 1)
    return figures


def _covered(kinds: Sequence[Tracked], group: str) -> tuple[float, float]:
    """Returns the percentage that the intervals of a group hold, and the usual deviation [mm]."""
    shares, deviations = [], []
    for kind in kinds:
        covered, sides = kind.errors.covered, kind.errors.deviations
        assert covered is not None
        assert sides is not None
        own = ~kind.hidden if group == "visible" else getattr(kind, group)
        shares.append(covered[own])
        deviations.append(sides[own])
    held = 100.0 * float(np.nanmean(np.concatenate(shares)))
    return held, 1000.0 * float(np.nanmedian(np.concatenate(deviations)))


def motion(rows: Sequence[Compared]) -> dict[str, Any]:
    """Prints what the filter and the smoother change; returns it."""
    (walk,) = (row for row in rows if row.name == WALK)
    print("\n| | mean [cm] | largest increase [cm] | left arm at the walk's end [cm] | time |")
    print("|---|" + "--:|" * 4)
    figures: dict[str, Any] = {}
    base = float(np.mean([row.best.seconds for row in rows]))
    for way in ("best", "filtered", "smoothed"):
        kinds = [getattr(row, way) for row in rows]
        more = max(kind.raw - row.best.raw for kind, row in zip(kinds, rows, strict=True))
        seconds = float(np.mean([kind.seconds for kind in kinds])) / base
        mean, arm = float(np.mean([kind.raw for kind in kinds])), getattr(walk, way).last(*ARM)
        print(f"| {way} | {mean:.3f} | {more:.2f} | {arm:.1f} | {seconds:.2f} |")
        figures[way] = {
            "raw_cm": round(mean, 3),
            "largest_increase_cm": round(more, 2),
            "hidden_arm_cm": round(arm, 1),
            "frame_time_over_best": round(seconds, 2),
        }
    ratios = [row.smoothed.jitter / row.filtered.jitter for row in rows]
    print(f"\njitter of the smoothed track over the filtered one: {np.mean(ratios):.2f}")
    figures["jitter_ratio"] = round(float(np.mean(ratios)), 3)
    return figures


if __name__ == "__main__":
    main()
