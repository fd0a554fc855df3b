"""Live tracking: processor time and latency of a frame at 30 Hz, and an hour of frames with faults.

The sample walk is played forth and back. First it comes at 30 Hz, as from a camera of which the
newest frame wins; then ``SOAK`` frames of it, an hour at 30 Hz, come as fast as they are tracked,
with the faults of real streams between them, and are written to disk as ``regkit track`` does.
"""

from __future__ import annotations

import argparse
import json
import resource
import subprocess
import sys
import tempfile
import time
import warnings
from collections.abc import Iterator
from dataclasses import replace
from pathlib import Path

import numpy as np

from regkit.api.live import LiveTrack, live_track
from regkit.api.pipeline import Pipeline
from regkit.interfaces import Source, Start, Stream, TimedFrame
from regkit.observation import Frame
from regkit.system.errors import DataError
from regkit.tracking import Track
from regkit.tracking.rows import RowsInFile

WALK = Path(__file__).parent.parent / "docs" / "examples" / "data" / "human_walk"
HUMAN = {"kind": "human", "height": 1.63}
FPS = 30.0
LIVE = 900
"""Frames at 30 Hz: half a minute."""

SOAK = 108_000
"""Frames of an hour at 30 Hz."""

EVERY = 1_000
"""There is one fault in so many frames, each kind in turn."""


class Walk(Stream):
    """The walk, forth and back, as often as needed; read once."""

    name, fps = "walk", FPS

    def __init__(self, length: int, *, live: bool, faulty: bool) -> None:
        self.length, self.live = length, live
        self._script = self._faulty() if faulty else self._plain()
        self._begun: float | None = None

    def read(self) -> TimedFrame | None:
        """Returns the next frame, at its time if it is live.

        Raises:
            DataError: If a fault is due.
        """
        frame = next(self._script, None)
        if isinstance(frame, DataError):
            raise frame
        if self.live and frame is not None:
            self._begun = time.perf_counter() if self._begun is None else self._begun
            time.sleep(max(self._begun + frame.time - time.perf_counter(), 0.0))
        return frame

    def _plain(self) -> Iterator[TimedFrame]:
        with Source.at(WALK).open() as stream:
            forth = [one.frame for one in iter(stream.read, None)]
        cycle = [*forth, *forth[-2:0:-1]]
        for number in range(self.length or 0):
            yield TimedFrame(cycle[number % len(cycle)], number / FPS)

    def _faulty(self) -> Iterator[TimedFrame | DataError]:
        """Yields the frames, and a fault now and then."""
        late, last = 0.0, None
        for number, frame in enumerate(self._plain()):
            kind = (number // EVERY) % 6 if number % EVERY == EVERY // 2 else None
            if kind == 0:
                yield DataError("cut short")
                continue
            if kind == 1 and last is not None:
                yield last
            if kind == 2:
                late -= 5.0
            if kind == 3:
                late += 10.0
            if kind == 4:
                frame = replace(frame, frame=halved(frame.frame))
            if kind == 5:
                # For ten frames two come in a second.
                late += 0.5 * 10
            last = replace(frame, time=frame.time + late)
            yield last


def halved(frame: Frame) -> Frame:
    """Returns a frame of half the resolution."""
    assert frame.depth is not None
    assert frame.camera is not None
    depth, whole = np.ascontiguousarray(frame.depth[::2, ::2]), frame.camera
    camera = replace(
        whole, width=depth.shape[1], height=depth.shape[0], fx=whole.fx / 2, fy=whole.fy / 2,
        cx=whole.cx / 2, cy=whole.cy / 2,
    )  # fmt: skip
    return Frame(camera.back_projected(depth), camera, depth, frame.place)


def at_camera_rate() -> dict[str, float]:
    """Tracks the walk at 30 Hz."""
    pipeline = Pipeline.of(HUMAN, place="live")
    cpu = []
    with live_track(lambda: Walk(LIVE, live=True, faulty=False), pipeline) as track:
        before, _ = time.thread_time(), track.start
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
        "dropped_percent": round(100.0 * track.dropped / LIVE, 3),
    }


def soak(count: int) -> dict[str, object]:
    """Tracks an hour of frames, with faults, onto the disk."""
    warnings.simplefilter("ignore")
    pipeline = Pipeline.of(HUMAN, place="live")
    with tempfile.TemporaryDirectory() as folder:
        file = Path(folder) / "frames.rows"

        def rows(start: Start) -> RowsInFile:
            return RowsInFile(Track.layout(start.body), file, {})

        stream = lambda: Walk(count, live=False, faulty=True)  # noqa: E731
        with live_track(stream, pipeline, rows=rows) as track:
            return _soaked(track, count)


def _soaked(track: LiveTrack, count: int) -> dict[str, object]:
    ends, memory, found = np.zeros(count + count // EVERY + 1), [], 0
    at = 0
    for at, pose in enumerate(track):
        ends[at] = time.process_time()
        found += pose.verdict == "found"
        if at in (count // 10, count - count // 50):
            memory.append(megabytes())
    seconds = np.diff(ends[: at + 1])
    tenth = len(seconds) // 10
    first, last = (
        1000.0 * float(np.median(part)) for part in (seconds[tenth : 2 * tenth], seconds[-tenth:])
    )
    return {
        "frames": at + 1,
        "found_percent": round(100.0 * found / (at + 1), 2),
        "memory_tenth_mb": round(memory[0], 1),
        "memory_end_mb": round(memory[-1], 1),
        "second_tenth_ms": round(first, 3),
        "last_tenth_ms": round(last, 3),
        "faults": dict(track.faults),
    }


def megabytes() -> float:
    """Returns the peak memory of this process [MB]."""
    return resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / 1024.0


def main() -> None:
    """Prints both, each measured in a process of its own."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--frames", type=int, default=SOAK, help="frames of the soak")
    parser.add_argument("--part", choices=("live", "soak"), help=argparse.SUPPRESS)
    given = parser.parse_args()
    if given.part is not None:
        found = at_camera_rate() if given.part == "live" else soak(given.frames)
        print(json.dumps(found))
        return
    figures: dict[str, object] = {"threads": 1}
    for part in ("live", "soak"):
        command = [sys.executable, __file__, "--part", part, "--frames", str(given.frames)]
        told = subprocess.run(command, check=True, stdout=subprocess.PIPE, text=True).stdout
        found = json.loads(told.splitlines()[-1])
        print(f"| {part} | |\n|---|--:|")
        for name, value in found.items():
            print(f"| {name} | {value} |")
        print(flush=True)
        figures |= found if part == "live" else {"soak": found}
    print(json.dumps(figures))


if __name__ == "__main__":
    main()
