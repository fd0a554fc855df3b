"""Reference joints in ``truth.csv``: rows of frame,joint,x,y,z."""

from __future__ import annotations

import csv
from pathlib import Path

import numpy as np

from regkit.clouds.formats.text.lines import lines_of
from regkit.geometry.camera import MAX_DISTANCE
from regkit.observation import Truth
from regkit.system.errors import DataError
from regkit.system.guard import reading
from regkit.system.notes import note
from regkit.system.plain_numbers import real, whole
from regkit.system.printable import shortened

HEADER = ["frame", "joint", "x", "y", "z"]

Row = tuple[int, str, tuple[float, float, float]]
"""Number of the frame, name of the joint, and its position [m]."""


def read_truth(path: Path, length: int) -> Truth | None:
    """Returns the reference joints of the first ``length`` frames; None if the file is missing.

    Raises:
        DataError: If a row cannot be read, or a number is not finite.
    """
    if not path.exists():
        return None
    if not path.is_file():
        raise DataError("this is not a file", place=str(path))
    with reading(path, "a file of reference joints"):
        rows = _rows(path)
    found = {(frame, joint): at for (frame, joint), at in rows.items() if frame < length}
    if rows and not found:
        note(f"no row is about the first {length} frames, so there are no errors", place=path)
    joints = tuple(dict.fromkeys(joint for _, joint in found))
    columns = {joint: column for column, joint in enumerate(joints)}
    positions = np.full((length, len(joints), 3), np.nan)
    for (frame, joint), at in found.items():
        positions[frame, columns[joint]] = at
    return Truth(joints, positions)


def _rows(path: Path) -> dict[tuple[int, str], tuple[float, float, float]]:
    """Returns all positions by frame and joint."""
    reader = csv.reader(lines_of(path))
    rows: dict[tuple[int, str], tuple[float, float, float]] = {}
    while True:
        try:
            cells = next(reader, None)
        except csv.Error as error:
            raise DataError(f"not a row: {error}", place=f"{path}:{reader.line_num}") from None
        place = f"{path}:{reader.line_num or 1}"
        if cells is None or reader.line_num <= 1:
            names = cells or []
            if not rows and names != HEADER and reader.line_num <= 1:
                raise DataError(
                    f"the header must be {','.join(HEADER)}; it is "
                    f"{shortened(','.join(names), 100)}",
                    place=f"{path}:1",
                )
            if cells is None:
                return rows
        elif cells:
            frame, joint, at = _row(cells, place)
            if (frame, joint) in rows:
                raise DataError(f"joint '{joint}' of frame {frame} is listed twice", place=place)
            rows[frame, joint] = at


def _row(cells: list[str], place: str) -> Row:
    text = ",".join(cells)
    try:
        frame, joint, x, y, z = cells
        number, at = whole(frame), (real(x), real(y), real(z))
        if number < 0 or not joint.strip():
            raise ValueError
    except ValueError:
        raise DataError(
            f"not a row of frame,joint,x,y,z: {shortened(text, 100)}", place=place
        ) from None
    if not np.isfinite(at).all():
        raise DataError(
            "a position is NaN or infinite; omit the row of an unseen joint", place=place
        )
    if max(map(abs, at)) > MAX_DISTANCE:
        raise DataError(
            f"a position is beyond any measurement [m]: {shortened(text, 100)}", place=place
        )
    return number, joint.strip(), at
