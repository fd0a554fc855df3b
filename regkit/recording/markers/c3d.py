"""Markers in C3D files, through ezc3d."""

from __future__ import annotations

import struct
from pathlib import Path

import numpy as np

from regkit.recording.markers.trajectories import Trajectories
from regkit.recording.markers.trc import UNITS
from regkit.system.errors import DataError
from regkit.system.optional import load_library

BLOCK, MAGIC, INTEL = 512, 0x50, 84
"""Size of a block [bytes], the second byte of each file, and the number of Intel's processors."""


def read_c3d(path: Path) -> Trajectories:
    """Returns the markers of a C3D file; a negative residual is an unmeasured marker.

    Raises:
        DependencyError: If ezc3d is not installed.
        DataError: If the file is damaged, or its unit is unknown.
    """
    library = load_library("ezc3d")
    _check_size(path.read_bytes())
    content = library.c3d(str(path))
    about = content["parameters"]["POINT"]
    unit = (about["UNITS"]["value"] or ["mm"])[0].strip()
    if unit not in UNITS:
        raise DataError(f"POINT:UNITS is '{unit}'; it must be {', '.join(UNITS)}")
    points = np.asarray(content["data"]["points"], dtype=np.float64)
    residuals = np.asarray(content["data"]["meta_points"]["residuals"])[0]
    names = tuple(name.strip() for name in about["LABELS"]["value"])
    positions = UNITS[unit] * points[:3, : len(names)].transpose(2, 1, 0)
    positions[residuals[: len(names)].T < 0.0] = np.nan
    return Trajectories(names, float(about["RATE"]["value"][0]), positions)


def _check_size(content: bytes) -> None:
    """Refuses a file that is shorter than it announces, in which ezc3d would search without end.

    Raises:
        DataError: If it is no C3D file, or cut off.
    """
    if len(content) < 2 * BLOCK or content[1] != MAGIC or not content[0]:
        raise DataError("it does not begin as a C3D file, or is cut off")
    parameters = BLOCK * (content[0] - 1)
    about = content[parameters : parameters + 4]
    if len(about) < 4 or len(content) < parameters + BLOCK * about[2]:
        raise DataError("it ends within its parameters")
    if about[3] != INTEL:
        raise DataError("it is of a processor other than Intel's; convert it")
    points, _, first, last = struct.unpack_from("<4H", content, 2)
    scale, data = struct.unpack_from("<fH", content, 12)
    # Negative scales mark real numbers of four bytes, others whole ones of two.
    width = 4 if scale < 0.0 else 2
    if len(content) < BLOCK * (data - 1) + 4 * width * points * max(last - first + 1, 0):
        raise DataError("it ends within its frames")
