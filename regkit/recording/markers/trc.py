"""Markers in TRC files: tab-separated text, as OpenSim and many motion-capture programs write."""

from __future__ import annotations

from pathlib import Path

import numpy as np

from regkit.clouds.formats.text.lines import lines_of
from regkit.recording.markers.trajectories import Trajectories
from regkit.system.errors import DataError
from regkit.system.plain_numbers import real, whole
from regkit.system.printable import shortened

UNITS = {"m": 1.0, "cm": 0.01, "mm": 0.001}
"""Length of each unit [m]."""

NAMES = 3
"""Index of the line with the names of the markers; that of the axes follows."""


def read_trc(path: Path) -> Trajectories:
    """Returns the markers of a TRC file; an empty cell is an unmeasured marker.

    Raises:
        DataError: If the header or a row cannot be read.
    """
    lines = [line.rstrip("\r\n") for line in lines_of(path)]
    if len(lines) <= NAMES + 1 or not lines[0].startswith("PathFileType"):
        raise DataError("a TRC file begins with PathFileType", place=f"{path}:1")
    about = dict(zip(lines[1].split("\t"), lines[2].split("\t"), strict=False))
    unit, rate = about.get("Units", "").strip(), about.get("DataRate", "").strip()
    if unit not in UNITS:
        raise DataError(
            f"the field Units is '{shortened(unit, 40)}'; it must be {', '.join(UNITS)}",
            place=f"{path}:3",
        )
    try:
        fps = real(rate)
    except ValueError:
        raise DataError(
            f"the field DataRate is '{shortened(rate, 40)}'; it must be a number",
            place=f"{path}:3",
        ) from None
    names = tuple(name.strip() for name in lines[NAMES].split("\t")[2:] if name.strip())
    rows = [
        _row(line, len(names), f"{path}:{number}")
        for number, line in enumerate(lines[NAMES + 2 :], NAMES + 3)
        if line.strip()
    ]
    told = about.get("NumFrames", "").strip()
    if told.isdigit() and int(told) != len(rows):
        raise DataError(f"the field NumFrames is {told}, but there are {len(rows)} rows")
    positions = UNITS[unit] * np.array(rows, dtype=np.float64).reshape(len(rows), len(names), 3)
    return Trajectories(names, fps, positions)


def _row(line: str, markers: int, place: str) -> list[float]:
    """Returns the coordinates (3 M) of a frame.

    Raises:
        DataError: If there are more or fewer, or one is not a number.
    """
    cells = [cell.strip() for cell in line.split("\t")]
    while len(cells) > 2 + 3 * markers and not cells[-1]:
        cells.pop()
    # Programs leave out the tabs behind the last measured marker.
    cells += [""] * (2 + 3 * markers - len(cells))
    if len(cells) != 2 + 3 * markers:
        raise DataError(
            f"a frame's number, its time and {3 * markers} coordinates must stand here; there are "
            f"{len(cells)} cells",
            place=place,
        )
    try:
        whole(cells[0]), real(cells[1])
        numbers = [real(cell) if cell else np.nan for cell in cells[2:]]
    except ValueError:
        raise DataError(f"not a row of numbers: {shortened(line, 100)}", place=place) from None
    for at in range(0, len(numbers), 3):
        if len({np.isnan(number) for number in numbers[at : at + 3]}) > 1:
            raise DataError(f"a coordinate of marker {at // 3 + 1} is missing", place=place)
    return numbers
