"""The files that ``regkit register`` and ``regkit track`` write."""

from __future__ import annotations

import math
from collections.abc import Mapping
from pathlib import Path
from typing import Any

from regkit.api import Tracking
from regkit.api.viewing import scene_of
from regkit.interfaces import Template
from regkit.report.png import png
from regkit.system.arrays import Array
from regkit.system.csv_table import CsvTable, write_csv
from regkit.system.errors import DataError
from regkit.system.files import replacing
from regkit.system.json_files import write_json
from regkit.tracking.track_folder import POSES, TrackDescription, finish_rows
from regkit.viewer.track_file import FILE, write_scene

DPI = 110

BESIDE_POSES = (
    "result.json",
    "markers.csv",
    "deviations.csv",
    "hinges.csv",
    "frames.csv",
    FILE,
    "picture.png",
)
"""Files of a result beside the poses and their description."""


def write_track(
    out: Path, tracking: Tracking, template: Template, figures: Mapping[str, Any]
) -> None:
    """Writes the result of tracking into a folder.

    Args:
        out: The folder.
        tracking: The result.
        template: The template, of which the start may have chosen the extended one.
        figures: The content of ``result.json``.

    Raises:
        RegkitError: If a file cannot be written.
    """
    chosen = template.chosen(extended=tracking.start.extended)
    about = (tracking.name, tracking.method, tracking.fps, tracking.size, chosen)
    TrackDescription.of(*about).write(out)
    write_json(out / "result.json", figures)
    write_csv(out / "markers.csv", *_markers(tracking))
    deviations = tracking.deviations
    if deviations is not None:
        write_csv(out / "deviations.csv", *_deviations(tracking, deviations))
    write_csv(out / "hinges.csv", *_hinges(tracking))
    write_csv(out / "frames.csv", *_frames(tracking))
    tracking.save(out / POSES)
    write_scene(scene_of(tracking), out)
    finish_rows(out)
    picture = png(tracking.plot(), DPI)
    with replacing(out / "picture.png") as temporary:
        temporary.write_bytes(picture)


def remove_former(out: Path) -> None:
    """Removes the result of a former track, which a new one in its folder would contradict.

    Raises:
        DataError: If a file cannot be removed.
    """
    for name in BESIDE_POSES:
        try:
            (out / name).unlink(missing_ok=True)
        except OSError as error:
            raise DataError(
                f"cannot be replaced: {error.strerror or error}", place=str(out / name)
            ) from None


def _markers(tracking: Tracking) -> CsvTable:
    """Returns the marker positions [m] in the format of a recording's ``truth.csv``."""
    return ("frame", "joint", "x", "y", "z"), (
        (frame, name, *(f"{value:.6f}" for value in position))
        for frame, markers in zip(tracking.numbers, tracking.markers, strict=True)
        for name, position in zip(tracking.joint_names, markers, strict=True)
    )


def _deviations(tracking: Tracking, deviations: Array) -> CsvTable:
    """Returns the standard deviations of the markers along the camera's axes [m]."""
    return ("frame", "joint", "x", "y", "z"), (
        (frame, name, *(f"{value:.6f}" if math.isfinite(value) else "" for value in sides))
        for frame, markers in zip(tracking.numbers, deviations, strict=True)
        for name, sides in zip(tracking.joint_names, markers, strict=True)
    )


def _hinges(tracking: Tracking) -> CsvTable:
    """Returns a row for each frame with a column ``NAME_rad`` or ``NAME_m`` for each hinge."""
    return ("frame", *tracking.body.skeleton.hinge_columns), (
        (frame, *(f"{angle:.6f}" for angle in angles))
        for frame, angles in zip(tracking.numbers, tracking.track.hinges, strict=True)
    )


def _frames(tracking: Tracking) -> CsvTable:
    """Returns a table of the frames: verdict, agreement with the data, and cost.

    Each of several bodies has a column of its own verdicts.
    """
    track = tracking.track
    columns = ("inlier_shares", "coverages", "misfits", "reliefs", "surface_distances")
    shares = zip(*(getattr(track, name) for name in columns), strict=True)
    return (
        "frame", "time_s", "verdict", "points", "inlier_share", "coverage", "misfit", "relief",
        "surface_distance_m", "converged", "seconds",
        *(f"verdict_{one.name}" for one in tracking.body.free_bodies),
    ), (
        (frame, f"{track.times[at]:.6f}", track.verdicts[at], int(track.points[at]),
         *(f"{value:.6g}" if math.isfinite(value) else "" for value in row),
         int(track.converged[at]), f"{track.seconds[at]:.6f}", *track.body_verdicts[at])
        for at, (frame, row) in enumerate(zip(tracking.numbers, shares, strict=True))
    )  # fmt: skip
