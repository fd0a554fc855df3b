"""Live tracking: processor time and latency of a frame at 30 Hz, and an hour of frames with faults.

The sample walk is played forth and back. First it comes at 30 Hz, as from a camera of which the
newest frame wins; then ``SOAK`` frames of it, an hour at 30 Hz, go through ``regkit track`` as fast
as they are tracked, with the faults of real streams between them.
"""

from __future__ import annotations

import argparse
import csv
import json
import os
import subprocess
import sys
import tempfile
import time
from pathlib import Path
from statistics import median

import numpy as np
from _live_walk import WalkStream

from regkit.api.live import live_track
from regkit.api.pipeline import Pipeline
from regkit.tracking.rows import LONGEST_HEAD, width

HUMAN = {"kind": "human", "height": 1.63}
LIVE = 900
"""Frames at 30 Hz: half a minute."""

SOAK = 108_000
"""Frames of an hour at 30 Hz."""

POLLED = 0.2
"""Time between two looks at the memory of the command [s]."""


def at_camera_rate() -> dict[str, float]:
    """Tracks the walk at 30 Hz."""
    pipeline = Pipeline.of(HUMAN, place="live")
    cpu = []
    with live_track(lambda: WalkStream(LIVE, live=True, faulty=False), pipeline) as track:
        track.begin()
        before = time.thread_time()
        for _ in track:
            now = time.thread_time()
            cpu.append(now - before)
            before = now
    # The first step loads what the method needs.
    times = 1000.0 * np.array(cpu[1:])
    return {
        "frames": len(times),
        "cpu_median_ms": round(float(np.median(times)), 3),
        "cpu_p99_ms": round(float(np.percentile(times, 99.0)), 3),
        "wall_median_ms": round(1000.0 * track.latency(0.5), 3),
        "wall_p99_ms": round(1000.0 * track.latency(0.99), 3),
        "dropped_percent": round(100.0 * track.dropped / (len(cpu) + track.dropped), 3),
    }


def soak(count: int) -> dict[str, object]:
    """Runs ``regkit track`` on many frames, and watches its memory."""
    with tempfile.TemporaryDirectory() as place:
        out = Path(place) / "out"
        plugin = Path(__file__).with_name("_live_walk.py")
        command = [
            sys.executable, "-m", "regkit", "track", f"walk:{count}", "--plugin", str(plugin),
            "--template", json.dumps(HUMAN), "--out", str(out),
        ]  # fmt: skip
        quiet = subprocess.DEVNULL
        process = subprocess.Popen(command, stdout=quiet, stderr=quiet)
        memory = _watched(process, out / "frames.rows", count)
        result = json.loads((out / "result.json").read_text())
        with (out / "frames.csv").open() as stream:
            seconds = [float(row["seconds"]) for row in csv.DictReader(stream)]
    tenth = len(seconds) // 10
    return {
        "frames": len(seconds),
        "exit_code": process.returncode,
        "found_percent": round(100.0 * result["found_frames"] / result["frames"], 2),
        **memory,
        "second_tenth_ms": round(1000.0 * median(seconds[tenth : 2 * tenth]), 3),
        "last_tenth_ms": round(1000.0 * median(seconds[-tenth:]), 3),
        "faults": result["faults"],
    }


def _watched(process: subprocess.Popen[bytes], rows: Path, count: int) -> dict[str, float]:
    """Returns the memory of a command [MB] during its track, and while it writes the results."""
    seen: list[tuple[float, float]] = []
    peak = 0.0
    while process.poll() is None:
        megabytes = _megabytes(process.pid)
        peak = max(peak, megabytes)
        if rows.exists():
            seen.append((_written(rows) / count, megabytes))
        time.sleep(POLLED)
    early = next((one for share, one in seen if share >= 0.1), float("nan"))
    late = next((one for share, one in seen if share >= 0.98), float("nan"))
    return {"memory_tenth_mb": early, "memory_end_mb": late, "memory_results_mb": peak}


def _written(rows: Path) -> float:
    """Returns the number of rows in a file that grows."""
    with rows.open("rb") as stream:
        head = stream.readline(LONGEST_HEAD)
    layout = {name: tuple(shape) for name, shape in json.loads(head)["layout"].items()}
    return (rows.stat().st_size - len(head)) / (8 * width(layout))


def _megabytes(process: int) -> float:
    """Returns the resident memory of a process [MB]."""
    try:
        pages = int(Path(f"/proc/{process}/statm").read_text().split()[1])
    except (OSError, IndexError):
        return 0.0
    return round(pages * os.sysconf("SC_PAGE_SIZE") / 2**20, 1)


def main() -> None:
    """Prints both, the first measured in a process of its own."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--frames", type=int, default=SOAK, help="frames of the soak")
    parser.add_argument("--live", action="store_true", help=argparse.SUPPRESS)
    given = parser.parse_args()
    if given.live:
        print(json.dumps(at_camera_rate()))
        return
    command = [sys.executable, __file__, "--live"]
    told = subprocess.run(command, check=True, stdout=subprocess.PIPE, text=True).stdout
    live = json.loads(told.splitlines()[-1])
    _print("at 30 Hz", live)
    soaked = soak(given.frames)
    _print("an hour of frames", soaked)
    print(json.dumps({"threads": 1, **live, "soak": soaked}))


def _print(title: str, figures: dict[str, object]) -> None:
    print(f"| {title} | |\n|---|--:|")
    for name, value in figures.items():
        print(f"| {name} | {value} |")
    print(flush=True)


if __name__ == "__main__":
    main()
