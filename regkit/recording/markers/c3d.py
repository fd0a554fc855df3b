"""Markers in C3D files, through ezc3d."""

from __future__ import annotations

from pathlib import Path

import numpy as np

from regkit.recording.markers.trajectories import Trajectories
from regkit.recording.markers.trc import UNITS
from regkit.system.errors import DataError
from regkit.system.optional import load_library


def read_c3d(path: Path) -> Trajectories:
    """Returns the markers of a C3D file; a negative residual is an unmeasured marker.

    Raises:
        DependencyError: If ezc3d is not installed.
        DataError: If the file is damaged, or its unit is unknown.
    """
    content = load_library("ezc3d").c3d(str(path))
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
