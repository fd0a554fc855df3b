"""Poses written as they come: CSV or JSON lines, into a file or to standard output."""

from __future__ import annotations

import csv
import json
import math
import sys
import time
from abc import ABC, abstractmethod
from collections.abc import Iterator
from pathlib import Path
from typing import Any, TextIO

import numpy as np

from regkit.api.live_pose import LivePose
from regkit.body import Body
from regkit.geometry.rotation import from_matrix
from regkit.system.csv_table import safe_cell
from regkit.system.errors import DataError

SUFFIXES = (".csv", ".jsonl")
"""Suffixes of files of poses."""

FLUSHED_EVERY = 0.5
"""Time after which what waits is written to a file [s]."""


class PoseStream(ABC):
    """Writes poses one by one.

    Args:
        path: The file, which is replaced; None for standard output.

    Raises:
        DataError: If the file cannot be written.
    """

    def __init__(self, path: Path | None) -> None:
        self._place = "standard output" if path is None else str(path)
        self._own = path is not None
        self._flushed = time.monotonic()
        self._stream: TextIO = sys.stdout
        if path is not None:
            try:
                path.parent.mkdir(parents=True, exist_ok=True)
                self._stream = path.open("w", encoding="utf-8", newline="")
            except OSError as error:
                raise self._unwritten(error) from None

    def add(self, pose: LivePose) -> None:
        """Writes a pose.

        Raises:
            DataError: If it cannot be written.
        """
        try:
            self._write(self._stream, pose)
            now = time.monotonic()
            # Who reads standard output waits for each pose.
            if not self._own or now - self._flushed >= FLUSHED_EVERY:
                self._stream.flush()
                self._flushed = now
        except OSError as error:
            raise self._unwritten(error) from None

    def close(self) -> None:
        """Writes what waits.

        Raises:
            DataError: If it cannot be written.
        """
        try:
            self._stream.flush()
            if self._own:
                self._stream.close()
        except OSError as error:
            raise self._unwritten(error) from None

    @abstractmethod
    def _write(self, stream: TextIO, pose: LivePose) -> None:
        """Writes a pose into a stream."""

    def _unwritten(self, error: OSError) -> DataError:
        return DataError(f"cannot be written: {error.strerror or error}", place=self._place)


class CsvPoses(PoseStream):
    """A row for each frame: root, unit quaternions x y z w, hinges [rad or m], and markers [m].

    The markers' standard deviations [m] follow, which are empty where they are unknown.
    """

    def __init__(self, path: Path | None, body: Body) -> None:
        super().__init__(path)
        self._writer = csv.writer(self._stream, lineterminator="\n")
        self._writer.writerow([safe_cell(name) for name in _columns(body)])

    def _write(self, stream: TextIO, pose: LivePose) -> None:
        root = pose.pose.root
        numbers = [
            *root[:3, 3],
            *from_matrix(root[:3, :3]),
            *pose.pose.balls.ravel(),
            *pose.pose.hinges,
            *pose.markers.ravel(),
        ]
        known = math.isfinite(pose.inlier_share)
        known_sides = pose.deviations
        deviations = np.full(pose.markers.size, np.nan) if known_sides is None else known_sides
        self._writer.writerow(
            [
                pose.number,
                f"{pose.time:.6f}",
                str(pose.verdict),
                f"{pose.inlier_share:.4f}" if known else "",
                f"{pose.latency:.6f}",
                *(f"{number:.6f}" for number in numbers),
                *("" if math.isnan(number) else f"{number:.6f}" for number in deviations.ravel()),
            ]
        )


class JsonPoses(PoseStream):
    """A JSON object for each frame, in one line."""

    def __init__(self, path: Path | None, body: Body) -> None:
        super().__init__(path)
        self._body = body

    def _write(self, stream: TextIO, pose: LivePose) -> None:
        skeleton, markers = self._body.skeleton, self._body.markers
        known = math.isfinite(pose.inlier_share)
        content: dict[str, Any] = {
            "frame": pose.number,
            "time": round(pose.time, 6),
            "verdict": str(pose.verdict),
            "inlier_share": round(pose.inlier_share, 4) if known else None,
            "latency": round(pose.latency, 6),
            "T_camera_root": _rounded(pose.pose.root),
            "balls": dict(zip(skeleton.ball_names, _rounded(pose.pose.balls), strict=True)),
            "hinges": dict(zip(skeleton.hinge_names, _rounded(pose.pose.hinges), strict=True)),
            "markers": dict(zip(markers.names, _rounded(pose.markers), strict=True)),
            "deviations": None
            if pose.deviations is None
            else dict(zip(markers.names, _rounded(pose.deviations), strict=True)),
        }
        stream.write(json.dumps(content, separators=(",", ":")) + "\n")


class PoseOutput:
    """The poses of a track as an output of ``regkit track``.

    Args:
        target: The file, or ``-``.
        body: The body.

    Raises:
        DataError: If the file cannot be written.
    """

    def __init__(self, target: str, body: Body) -> None:
        self._stream = _pose_stream(target, body)

    def add(self, pose: LivePose, status: str) -> None:
        """Writes a pose."""
        self._stream.add(pose)

    def close(self) -> None:
        """Writes what waits."""
        self._stream.close()


def _pose_stream(target: str, body: Body) -> PoseStream:
    """Returns the stream of ``--out``: a ``.csv`` or ``.jsonl`` file, or ``-``.

    Raises:
        DataError: If the file cannot be written.
    """
    if target == "-":
        return JsonPoses(None, body)
    path = Path(target)
    kind = CsvPoses if path.suffix.lower() == ".csv" else JsonPoses
    return kind(path, body)


def is_pose_stream(target: str) -> bool:
    """Returns whether a target of ``--out`` is a stream of poses, and no folder."""
    return target == "-" or Path(target).suffix.lower() in SUFFIXES


def _columns(body: Body) -> Iterator[str]:
    yield from ("frame", "time_s", "verdict", "inlier_share", "latency_s")
    yield from ("root_x", "root_y", "root_z", "root_qx", "root_qy", "root_qz", "root_qw")
    for name in body.skeleton.ball_names:
        yield from (f"{name}_q{axis}" for axis in "xyzw")
    yield from body.skeleton.hinge_columns
    for part in ("", "sigma_"):
        for name in body.markers.names:
            yield from (f"{name}_{part}{axis}" for axis in "xyz")


def _rounded(array: Any) -> Any:
    return array.round(6).tolist()
