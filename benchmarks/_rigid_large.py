"""Time and memory of the alignment of two large clouds, in a process of its own.

    python benchmarks/_rigid_large.py POINTS VOXEL

Both clouds lie on the same closed surface, with noise. The last line is a JSON object.
"""

from __future__ import annotations

import json
import sys
import time
from collections.abc import Callable
from functools import partial
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np
from threadpoolctl import threadpool_limits

from regkit.alignment import Alignment, align
from regkit.cli.choices import method_named
from regkit.geometry.rigid import rigid, transformed
from regkit.geometry.rotation import vector_to_matrix
from regkit.system.arrays import Array

CHUNK = 100_000
REPEATS = 3
TRUTH = rigid(vector_to_matrix(np.array([0.1, 0.2, 0.1])), np.array([0.1, 0.0, 0.05]))


def surface(count: int, seed: int) -> Array:
    """Returns points (N, 3) [m] on a bumpy ball of about a metre, with a millimetre of noise.

    They are made in small parts, so that making them leaves no peak of memory.
    """
    random, points = np.random.default_rng(seed), np.empty((count, 3))
    for begin in range(0, count, CHUNK):
        part = points[begin : begin + CHUNK]
        unit = random.normal(size=part.shape)
        unit /= np.linalg.norm(unit, axis=1, keepdims=True)
        x, y, z = unit.T
        radius = 1.0 + 0.2 * np.sin(3.0 * x + 1.0) * np.cos(4.0 * y) + 0.1 * z * x
        part[:] = radius[:, None] * unit * [1.0, 0.8, 0.6] + 1e-3 * random.normal(size=part.shape)
    return points


def memory(which: str) -> float:
    """Returns the memory of the process now (VmRSS) or at most (VmHWM) [MB], as Linux tells."""
    lines = Path("/proc/self/status").read_text().splitlines()
    return next(int(line.split()[1]) for line in lines if line.startswith(which)) / 1024


class Times(NamedTuple):
    """Time of an alignment on the clock, and the time of processors that it needs [s].

    The latter is that of the main thread and, divided by their number, of all other threads. It is
    what the clock would show if nobody else used the processors.
    """

    clock: float
    needed: float


def timed(threads: int, aligned: Callable[[], Alignment]) -> Times:
    """Returns the times of an alignment with a number of threads."""
    clock, everyone, main = time.perf_counter(), time.process_time(), time.thread_time()
    aligned()
    clock, everyone = time.perf_counter() - clock, time.process_time() - everyone
    main = time.thread_time() - main
    return Times(clock, main + (everyone - main) / threads)


def measured(count: int, voxel: float | None) -> dict[str, Any]:
    """Returns the least times for one and two threads in turn, and the growth of the memory."""
    source, target = surface(count, 0), surface(count, 1)
    for begin in range(0, count, CHUNK):
        target[begin : begin + CHUNK] = transformed(TRUTH, target[begin : begin + CHUNK])
    method = method_named("rigid")
    for threads in (1, 2):
        # The first call compiles, and loads what it needs.
        align(source[:3000], target[:3000], method, start="nearest", threads=threads)
    # The peak before is forgotten.
    Path("/proc/self/clear_refs").write_text("5")
    before = memory("VmRSS")
    found = align(source, target, method, voxel=voxel, start="nearest")
    growth = memory("VmHWM") - before
    runs: dict[int, list[Times]] = {1: [], 2: []}
    for _ in range(REPEATS):
        for threads, times in runs.items():
            run = partial(
                align, source, target, method, voxel=voxel, start="nearest", threads=threads
            )
            times.append(timed(threads, run))
    alone, both = (Times(*np.min(times, axis=0)) for times in runs.values())
    return {
        "points": count,
        "aligned": found.points[0],
        "seconds": round(alone.clock, 3),
        "seconds_two_threads": round(both.clock, 3),
        "processor_seconds": round(alone.needed, 3),
        "processor_seconds_two_threads": round(both.needed, 3),
        "speedup_two_threads": round(alone.needed / both.needed, 2),
        "memory_growth_mb": round(growth),
        "rotation_error": round(float(np.abs(found.transform - TRUTH)[:3, :3].max()), 6),
    }


if __name__ == "__main__":
    with threadpool_limits(1):
        voxel = None if sys.argv[2] == "default" else float(sys.argv[2])
        print(json.dumps(measured(int(sys.argv[1]), voxel)))
