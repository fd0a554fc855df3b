"""Export of tracked motion as CSV."""

from __future__ import annotations

from pathlib import Path

from regkit.geometry.rotation import from_matrix
from regkit.interchange.motion import TrackedMotion
from regkit.system.csv_table import csv_text
from regkit.system.files import write_text

PLACE, TURN = ("x", "y", "z"), ("qx", "qy", "qz", "qw")

COLUMNS = ("frame", "time", "kind", "name", *PLACE, *TURN, "angle_rad", "displacement_m", "verdict")
"""Columns of the table: times in [s], positions in [m] in the camera frame (x right, y down, z
forward), angles in [rad], displacements in [m]; the verdict is that of the frame."""


def write_csv(motion: TrackedMotion, path: Path) -> None:
    """Writes a row for each segment, each marker and each hinge in each frame.

    The row of a segment has its origin and the unit quaternion of ``R_camera_segment`` with
    qw >= 0; that of a marker has its position, that of a hinge its angle alone, and that of a
    prismatic joint its displacement.

    Raises:
        DataError: If the file cannot be written.
    """
    rows: list[tuple[object, ...]] = []
    skeleton, markers = motion.body.skeleton, motion.body.markers
    verdicts = motion.verdicts or ("",) * len(motion.times)
    frames = zip(motion.times, motion.transforms, motion.hinges, verdicts, strict=True)
    for frame, (time, transforms, hinges, verdict) in enumerate(frames):
        when = (frame, f"{time:.6f}")
        quaternions = from_matrix(transforms[:, :3, :3])
        places = zip(skeleton.names, transforms[:, :3, 3], quaternions, strict=True)
        for name, place, quaternion in places:
            rows.append((*when, "segment", name, *_words([*place, *quaternion]), "", "", verdict))
        for name, place in zip(markers.names, markers.place(transforms), strict=True):
            rows.append((*when, "marker", name, *_words(list(place)), *[""] * 6, verdict))
        slides = skeleton.limits.prismatic
        for name, value, slide in zip(skeleton.hinge_names, hinges, slides, strict=True):
            kind, cells = ("prismatic", [[], [value]]) if slide else ("hinge", [[value], []])
            words = (word for cell in cells for word in _words(cell) or [""])
            rows.append((*when, kind, name, *[""] * 7, *words, verdict))
    write_text(path, csv_text(COLUMNS, rows))


def _words(numbers: list[float]) -> list[str]:
    return [f"{number + 0.0:.8f}" for number in numbers]
