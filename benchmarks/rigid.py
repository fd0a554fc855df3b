"""Success, accuracy and speed of rigid alignment by regkit and by other libraries.

    python benchmarks/rigid.py [--large] [--only dragon|any] [VIEWS.npz]

First the pairs in any orientation: views of one object, 24 to 96 degrees apart (the dragon, or
those in a file with ``view_024`` and ``T_world_view_024``), in 5,000 points, each source turned at
random; the bunny with outliers, and the LiDAR scans. ``--only dragon`` measures the views alone,
and ``--only any`` these three.

A bunny of 453 points is rotated by 10, 30, 60 and 90 degrees about random axes and shifted by a
tenth of its size, ten times each: unchanged; with noise of 1 % of its size on both clouds; with
60 % overlap; with 30 % outliers in each cloud; with all of these. Every method starts with equal
centroids. An alignment succeeds if it ends within 5 degrees and 5 % of the size of the truth. This
is less than the spacing of the points across the bunny, so that the remaining error comes from the
data's noise, and every local method continues from there to the same minimum. A pair of LiDAR
scans with known truth follows, with 35,000 and 20,000 points of each. One thread throughout, except
for the last table: a million points of a surface in each cloud, with one and two threads in turn;
with ``--large`` also five million, and a million without downsampling.
"""

from __future__ import annotations

import argparse
import json
import resource
import subprocess
import sys
import time
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import numpy as np
from _rigid_any import bunnies, turned_lidar, views
from _rigid_pairs import Pair, bunny
from threadpoolctl import threadpool_limits

from regkit.alignment import align, read_transform
from regkit.cli.choices import method_named
from regkit.clouds import read_cloud
from regkit.interfaces import Method
from regkit.system.arrays import Array
from regkit.system.errors import DependencyError, RegkitError

DATA = Path(__file__).parents[2] / "shared" / "data"
SEEDS, ANGLES = 10, (10, 30, 60, 90)
WITHIN_DEG, WITHIN_SIZE = 5.0, 0.05
CONDITIONS: dict[str, dict[str, float]] = {
    "clean": {},
    "noise": {"noise": 0.01},
    "overlap": {"overlap": 0.6},
    "outliers": {"outliers": 0.3},
    "all": {"noise": 0.01, "overlap": 0.6, "outliers": 0.3},
}
ICP = "kind: open3d_icp, distance: {distance}, estimation"
METHODS = {
    "regkit, G-SoG": "{{preset: rigid}}",
    "regkit, round data": "{{preset: rigid, kernel: {{flatness: 1}}}}",
    # As many searches as in all resolutions together.
    "regkit, finest only": "{{preset: rigid, coarsest: 0.001, searches: 60}}",
    "regkit, SoG": "{{preset: rigid, shape: {{kind: cloud_sog}}, kernel: {{flatness: 1}}}}",
    "Open3D, point to point": f"{{{{{ICP}: point_to_point}}}}",
    "Open3D, point to plane": f"{{{{{ICP}: point_to_plane}}}}",
    "Open3D, generalized": f"{{{{{ICP}: generalized}}}}",
    "small_gicp, GICP": "{{kind: small_gicp, distance: {distance}}}",
    "probreg, CPD": "{{kind: probreg_cpd}}",
    "probreg, FilterReg": "{{kind: probreg_filterreg, shrinking: true}}",
    "biocpd, CPD": "{{kind: biocpd}}",
}
"""By name; ``distance`` is a library's maximum distance, relative to the source's size."""


def methods(distance: float) -> Iterator[tuple[str, Method]]:
    """Yields the installed methods."""
    for name, text in METHODS.items():
        yield name, method_named(text.format(distance=distance))


def robustness(points: Array) -> dict[str, dict[str, Any]]:
    """Prints the bunny's table and returns its figures."""
    heads = [*CONDITIONS, *(f"{angle} deg" for angle in ANGLES), "of 200"]
    print(f"\n| bunny | {' | '.join(heads)} | rotation [deg] | shift [%] | time [ms] |")
    print("|---|" + "--:|" * (len(heads) + 3))
    figures: dict[str, dict[str, Any]] = {}
    for name, method in methods(distance=0.2):
        found: dict[tuple[str, int], int] = {}
        errors, seconds = [], []
        try:
            for condition, values in CONDITIONS.items():
                for angle in ANGLES:
                    found[condition, angle] = 0
                    for seed in range(SEEDS):
                        pair = bunny(points, angle, seed, **values)
                        turn, shift, took = aligned(pair, method)
                        seconds.append(took)
                        if turn < WITHIN_DEG and shift < WITHIN_SIZE:
                            found[condition, angle] += 1
                            errors.append((turn, shift))
        except DependencyError as error:
            print(f"{name} is skipped: {error}", file=sys.stderr)
            continue
        by_condition = [sum(n for (c, _), n in found.items() if c == one) for one in CONDITIONS]
        by_angle = [sum(n for (_, a), n in found.items() if a == one) for one in ANGLES]
        counts = [*by_condition, *by_angle, sum(found.values())]
        turn, shift = np.median(errors, axis=0) if errors else (np.nan, np.nan)
        took = 1000.0 * float(np.median(seconds))
        print(
            f"| {name} | {' | '.join(map(str, counts))} | {turn:.2f} | {100 * shift:.2f} "
            f"| {took:.1f} |",
            flush=True,
        )
        figures[name] = {
            "success": dict(zip(heads, counts, strict=True)),
            "rotation_deg": round(float(turn), 3),
            "shift_percent": round(100 * float(shift), 3),
            "milliseconds": round(took, 2),
        }
    return with_ratios(figures)


def with_ratios(figures: dict[str, dict[str, Any]]) -> dict[str, dict[str, Any]]:
    """Returns the figures, with every time relative to that of small_gicp in the same run."""
    base = figures.get("small_gicp, GICP", {}).get("milliseconds")
    for row in figures.values():
        row["time_to_small_gicp"] = round(row["milliseconds"] / base, 2) if base else None
    return figures


def any_orientation(points: Array) -> dict[str, Any]:
    """Prints results for rotations by 150 degrees, with the starts for any orientation."""
    print(f"\n| bunny, 150 deg, of {SEEDS} | {' | '.join(CONDITIONS)} | time [s] |")
    print("|---|" + "--:|" * (len(CONDITIONS) + 1))
    figures: dict[str, Any] = {}
    chosen = dict(methods(distance=0.2))
    names = ("regkit, G-SoG", "small_gicp, GICP")
    for name in names:
        for start in ("auto", "rotations", "open3d_features"):
            counts, seconds = [], []
            for values in CONDITIONS.values():
                pairs = [bunny(points, 150.0, seed, **values) for seed in range(SEEDS)]
                runs = [aligned(pair, chosen[name], start=start) for pair in pairs]
                seconds += [took for _, _, took in runs]
                good = [turn < WITHIN_DEG and shift < WITHIN_SIZE for turn, shift, _ in runs]
                counts.append(sum(good))
            took = float(np.nanmedian(seconds))
            row = f"{name}, --start {start}"
            print(f"| {row} | {' | '.join(map(str, counts))} | {took:.2f} |", flush=True)
            figures[row] = {"success": dict(zip(CONDITIONS, counts, strict=True)), "seconds": took}
    ours, theirs = (figures[f"{name}, --start rotations"] for name in names)
    figures["rotations_time_to_small_gicp"] = round(ours["seconds"] / theirs["seconds"], 2)
    return figures


def aligned(
    pair: Pair, method: Method, voxel: float = 0.0, start: str = "centroids"
) -> tuple[float, float, float]:
    """Returns rotation error [deg], translation error relative to the size, and CPU seconds."""
    processor, clock = time.process_time(), time.perf_counter()
    try:
        found = align(pair.source, pair.target, method, voxel=voxel, start=start)
    except DependencyError:
        raise
    except RegkitError:
        return np.inf, np.inf, np.nan
    # On one thread the processor's share of the time is what others left; it is taken out.
    share = (time.process_time() - processor) / (time.perf_counter() - clock)
    return (*pair.errors(found.transform), found.seconds * share)


def lidar(count: int, voxel: float) -> dict[str, dict[str, Any]]:
    """Prints the table of the LiDAR pair with ``count`` points of each, in voxels [m] or all."""
    folder = DATA / "rigid_lidar_mit"
    random = np.random.default_rng(0)
    clouds = [read_cloud(folder / f"{name}.ply") for name in ("source", "target")]
    source, target = (one[random.choice(len(one), count, replace=False)] for one in clouds)
    size = float(np.linalg.norm(np.ptp(source, axis=0)))
    pair = Pair(source, target, read_transform(str(folder / "T_target_source.txt")), size)
    thin = f"in voxels of {voxel} m" if voxel else "all"
    print(f"\n| LiDAR, {count} points, {thin} | rotation [deg] | shift [mm] | time [ms] |")
    print("|---|--:|--:|--:|")
    figures: dict[str, dict[str, Any]] = {}
    # small_gicp's own default distance is 1 m.
    for name, method in methods(distance=1.0 / size):
        if not voxel and ("CPD" in name or "FilterReg" in name):
            continue
        if voxel and "probreg, CPD" in name:
            continue
        try:
            runs = [aligned(pair, method, voxel) for _ in range(3 if "CPD" not in name else 1)]
        except DependencyError:
            continue
        turn, shift, _ = runs[0]
        took = 1000.0 * min(run[2] for run in runs)
        print(f"| {name} | {turn:.3f} | {1000 * size * shift:.1f} | {took:.0f} |", flush=True)
        figures[name] = {
            "rotation_deg": round(turn, 4),
            "shift_mm": round(1000 * size * shift, 2),
            "milliseconds": round(took, 1),
        }
    return with_ratios(figures)


def peak_memory() -> int:
    """Returns the peak memory of the process so far [MB]."""
    return round(resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / 1024)


def ours_on_all_points() -> dict[str, object]:
    """Returns memory of regkit's method on 35,000 points each, before anything else runs."""
    folder = DATA / "rigid_lidar_mit"
    clouds = [read_cloud(folder / f"{name}.ply")[::2][:35_000] for name in ("source", "target")]
    before = peak_memory()
    (_, method), *_ = methods(distance=0.1)
    found = align(*clouds, method, voxel=0.0)
    print(
        f"regkit, G-SoG, {found.points[0]} against {found.points[1]} points, first call in the "
        f"process: {found.seconds:.2f} s; memory {peak_memory()} MB at most, {before} MB before"
    )
    return {"memory_mb": peak_memory(), "memory_before_mb": before}


def large(everything: bool) -> dict[str, dict[str, Any]]:
    """Prints the table of large clouds, each in a process of its own, and returns its figures."""
    heads = ["aligned", "clock [s]", "processor [s]", "with two threads [s]", "ratio"]
    print(f"\n| points of each | {' | '.join(heads)} | memory [MB] |")
    print("|---|" + "--:|" * (len(heads) + 1))
    figures: dict[str, dict[str, Any]] = {}
    more = [("5000000", "default"), ("1000000", "0")] if everything else []
    for count, voxel in [("1000000", "default"), *more]:
        script = Path(__file__).with_name("_rigid_large.py")
        ran = subprocess.run(
            [sys.executable, script, count, voxel], check=True, stdout=subprocess.PIPE, text=True
        )
        row = json.loads(ran.stdout.splitlines()[-1])
        print(
            f"| {count} | {row['aligned']} | {row['seconds']:.2f} | {row['processor_seconds']:.2f} "
            f"| {row['processor_seconds_two_threads']:.2f} | {row['speedup_two_threads']:.2f} "
            f"| {row['memory_growth_mb']} |",
            flush=True,
        )
        figures[f"{count}, voxel {voxel}"] = row
    return figures


def in_any_orientation(file: Path, only: str | None) -> dict[str, object]:
    """Returns the figures of pairs in any orientation."""
    figures: dict[str, object] = {"dragon": views(file)}
    if only != "dragon":
        points = read_cloud(DATA / "rigid_misc" / "bunny_source.txt")
        figures["bunny with outliers"] = bunnies(points, seeds=4)
        figures["lidar turned"] = turned_lidar(DATA / "rigid_lidar_mit", seeds=5)
    return figures


def main() -> None:
    """Prints the tables, and their figures as one JSON object in the last line."""
    parser = argparse.ArgumentParser(description="Rigid alignment, compared.")
    parser.add_argument("views", nargs="?", type=Path, help="another file of views")
    parser.add_argument("--large", action="store_true", help="five million points, too")
    parser.add_argument("--only", choices=["dragon", "any"], help="a part of the benchmark")
    options = parser.parse_args()
    file = options.views or DATA / "dragon_stanford" / "views.npz"
    if not file.is_file() or (options.only != "dragon" and not DATA.is_dir()):
        sys.exit(f"the reference data are not at {file} and {DATA}")
    with threadpool_limits(1):
        figures: dict[str, object] = {"threads": 1}
        if options.only is None:
            # The peak of the memory is measured before anything else runs.
            figures["all points"] = ours_on_all_points()
        figures |= in_any_orientation(file, options.only)
        if options.only is None:
            points = read_cloud(DATA / "rigid_misc" / "bunny_source.txt")
            figures["bunny"] = robustness(points)
            figures["bunny, any orientation"] = any_orientation(points)
            for count, voxel in ((35_000, 0.25), (35_000, 0.0), (20_000, 0.0)):
                figures[f"lidar {count}, voxel {voxel}"] = lidar(count, voxel)
            figures["large"] = large(options.large)
    print(json.dumps(figures))


if __name__ == "__main__":
    main()
