"""Keypoints in a CSV file: rows of frame,name,x,y,confidence or frame,name,x,y,z,confidence."""

from __future__ import annotations

import csv
from pathlib import Path

from regkit.clouds.formats.text.lines import lines_of
from regkit.observation import Keypoints
from regkit.recording.keypoints.table import KeypointTable
from regkit.system.errors import DataError
from regkit.system.plain_numbers import real, whole
from regkit.system.printable import shortened

FLAT = ["frame", "name", "x", "y", "confidence"]
"""Header of keypoints in the picture [pixels]."""

SPACE = ["frame", "name", "x", "y", "z", "confidence"]
"""Header of keypoints in the camera frame [m]."""


def read_csv_keypoints(path: Path) -> Keypoints:
    """Returns the keypoints of a CSV file.

    Raises:
        DataError: If the header or a row cannot be read.
    """
    reader, table = csv.reader(lines_of(path)), KeypointTable()
    header: list[str] | None = None
    while True:
        try:
            cells = next(reader, None)
        except csv.Error as error:
            raise DataError(f"not a row: {error}", place=f"{path}:{reader.line_num}") from None
        place = f"{path}:{max(reader.line_num, 1)}"
        if header is None:
            header = [cell.strip() for cell in cells or []]
            if header not in (FLAT, SPACE):
                raise DataError(
                    f"the header must be {','.join(FLAT)} or {','.join(SPACE)}; it is "
                    f"{shortened(','.join(header), 100)}",
                    place=place,
                )
        elif cells is None:
            return table.keypoints((path,))
        elif cells:
            _add(table, cells, header, place)


def _add(table: KeypointTable, cells: list[str], header: list[str], place: str) -> None:
    """Adds the keypoint of a row.

    Raises:
        DataError: If it cannot be read.
    """
    try:
        frame, name, *numbers = cells
        *at, confidence = map(real, numbers)
        if len(cells) != len(header) or whole(frame) < 0 or not name.strip():
            raise ValueError
        number = whole(frame)
    except ValueError:
        raise DataError(
            f"not a row of {','.join(header)}: {shortened(','.join(cells), 100)}", place=place
        ) from None
    try:
        table.add(number, name.strip(), tuple(at), confidence)
    except DataError as error:
        raise error.at(place) from None
