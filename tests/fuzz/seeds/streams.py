"""Recordings of other programs: bags of ROS, MCAP files, and those of cameras."""

from __future__ import annotations

import tempfile
from collections.abc import Callable, Iterator
from pathlib import Path

import numpy as np

from regkit import open_source
from regkit.interfaces import Stream, TimedFrame
from regkit.system.errors import SourceLostError
from tests.fuzz import oracles
from tests.fuzz.kind import Damaged, Files, Kind
from tests.fuzz.seeds.recordings import depth_folder, of_frame

FRAMES = 3
MOST = 1e12
"""No clock shows more seconds."""

Read = tuple[Stream, list[TimedFrame]]


def bag(kind: str) -> Callable[[], list[Files]]:
    """Returns what makes a bag of a few small images."""

    def made() -> list[Files]:
        from bags import camera_row, image_row, write_bag

        from regkit.geometry import Camera

        camera = Camera(24, 18, 20.0, 21.0, 11.3, 8.9)
        image = np.full((18, 24), 1500, np.uint16)
        rows = [camera_row(camera), *(image_row(image, n) for n in range(FRAMES))]
        with tempfile.TemporaryDirectory() as folder:
            path = write_bag(Path(folder) / "walk", kind, rows)
            return [{f"walk.{kind.split()[0]}": path.read_bytes()}]

    return made


def kinect() -> list[Files]:
    from kinect_files import kinect_bytes

    return [{"walk.mkv": kinect_bytes([np.full((288, 320), 1500, np.uint16)] * FRAMES)}]


def read(path: Path) -> Read:
    """Reads all frames; those before the end of a file that is cut short are kept."""
    with open_source(path) as stream:
        found: list[TimedFrame] = []
        try:
            found.extend(stream)
        except SourceLostError:
            if not found:
                raise
        return stream, found


def nonsense(value: Read, file: Damaged) -> Iterator[str]:
    stream, found = value
    if not 0.0 < stream.fps < np.inf:
        yield f"fps: {stream.fps}"
    times = np.array([timed.time for timed in found])
    yield from oracles.numbers(times, "times", most=MOST)
    if (np.diff(times) < 0.0).any():
        yield f"times: {times}"
    for timed in found:
        yield from of_frame(timed.frame)


def _timed_folder() -> list[Files]:
    (files,) = depth_folder()
    return [{**files, "times.csv": b"frame,time_s\n0,1.5\n1,1.75\n"}]


STREAMS = (
    Kind(
        "streams/folder", _timed_folder, {"times.csv": "text", "camera.json": "json"},
        read, nonsense, whole=True,
    ),
    *(
        Kind(f"streams/{name}", bag(kind), {f"walk.{name}": "binary"}, read, nonsense, weight=0.5)
        for name, kind in (("mcap", "mcap file"), ("db3", "db3 file"), ("bag", "bag"))
    ),
    Kind("streams/mkv", kinect, {"walk.mkv": "binary"}, read, nonsense, weight=0.5),
)  # fmt: skip
