"""Export of tracked motion as CSV."""

from __future__ import annotations

from pathlib import Path

from regkit.geometry.rotation import from_matrix
from regkit.interchange.motion import TrackedMotion
from regkit.system.csv_table import csv_text
from regkit.system.files import write_text

COLUMNS = ("frame", "time", "kind", "name", "x", "y", "z", "qx", "qy", "qz", "qw")
"""Columns of the table: times in [s], positions in [m] in the camera frame (x right, y down, z
forward)."""


def write_csv(motion: TrackedMotion, path: Path) -> None:
    """Writes a row for each segment and each marker in each frame.

    The row of a segment has its origin and the unit quaternion of ``R_camera_segment`` with
    qw >= 0; that of a marker has no quaternion.

    Raises:
        DataError: If the file cannot be written.
    """
    rows: list[tuple[object, ...]] = []
    names, markers = motion.body.skeleton.names, motion.body.markers
    for frame, (time, transforms) in enumerate(zip(motion.times, motion.transforms, strict=True)):
        when = (frame, f"{time:.6f}")
        quaternions = from_matrix(transforms[:, :3, :3])
        for name, place, quaternion in zip(names, transforms[:, :3, 3], quaternions, strict=True):
            rows.append((*when, "segment", name, *_words([*place, *quaternion])))
        for name, place in zip(markers.names, markers.place(transforms), strict=True):
            rows.append((*when, "marker", name, *_words(list(place)), "", "", "", ""))
    write_text(path, csv_text(COLUMNS, rows))


def _words(numbers: list[float]) -> list[str]:
    return [f"{number + 0.0:.8f}" for number in numbers]
