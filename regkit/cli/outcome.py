"""Output of ``regkit register`` and ``regkit track``: a table, files, and an exit code."""

from __future__ import annotations

import csv
import json
import math
from io import StringIO
from pathlib import Path
from typing import Any

import numpy as np
import typer
from rich.markup import escape
from rich.table import Table

from regkit.api import Tracking
from regkit.cli.console import errors, output
from regkit.cli.hinge_table import hinge_table
from regkit.report.png import png
from regkit.system.files import replacing, write_json, write_text

DPI = 110


def finish(tracking: Tracking, out: Path | None, *, as_json: bool) -> None:
    """Prints the result, writes it to a folder, and fails if the body was lost.

    Raises:
        RegkitError: If a file cannot be written.
        Exit: With code 1, if the body was lost.
    """
    figures = _figures(tracking)
    if as_json:
        typer.echo(json.dumps(figures, indent=2, allow_nan=False))
    else:
        output.print(_table(tracking, figures))
    if out is not None:
        _write(tracking, figures, out)
        errors.print(f"written: {out}", highlight=False, soft_wrap=True)
    if tracking.doubt is not None:
        errors.print(
            f"{'error' if tracking.lost else 'warning'}: {tracking.doubt}",
            style="red" if tracking.lost else "yellow",
            markup=False,
            highlight=False,
            soft_wrap=True,
        )
    if tracking.lost:
        raise typer.Exit(1)


def _figures(tracking: Tracking) -> dict[str, Any]:
    """Returns the content of ``result.json``, with the pose for a single frame."""
    track = tracking.track
    figures: dict[str, Any] = {
        "lost": tracking.lost,
        "doubt": tracking.doubt,
        "frames": len(tracking),
        "doubtful_frames": int(tracking.doubtful.sum()),
        "converged_frames": int(track.converged.sum()),
        "template": tracking.body.name,
        "size": tracking.size,
        "method": tracking.method,
        "surface_distance_mm": _finite(1000.0 * np.median(track.surface_distances)),
        "inlier_share": _finite(np.mean(track.inlier_shares)),
        "frames_per_second": len(tracking) / float(track.seconds.sum()),
        "marker_names": list(tracking.joint_names),
    }
    if len(tracking) == 1:
        skeleton = tracking.body.skeleton
        figures["T_camera_root"] = track.root[0].tolist()
        figures["balls"] = dict(zip(skeleton.ball_names, track.balls[0].tolist(), strict=True))
        figures["hinges"] = dict(zip(skeleton.hinge_names, track.hinges[0].tolist(), strict=True))
        figures["markers"] = dict(zip(tracking.joint_names, track.markers[0].tolist(), strict=True))
    return figures


def _table(tracking: Tracking, figures: dict[str, Any]) -> Table:
    distance, share = figures["surface_distance_mm"], figures["inlier_share"]
    doubts = f"{figures['doubtful_frames']} of {len(tracking)}"
    table = Table(show_header=False)
    for name, value in (
        ("frames", f"{tracking.name}, {len(tracking)}"),
        ("method", tracking.method),
        ("body", f"{tracking.body.name}, {tracking.size:.4g} m"),
        ("markers", str(len(tracking.joint_names))),
        ("surface distance", "-" if distance is None else f"{distance:.1f} mm (median)"),
        ("inliers", "-" if share is None else f"{100.0 * share:.0f} % of the points"),
        ("converged", f"{figures['converged_frames']} of {len(tracking)}"),
        ("doubtful", doubts),
        ("lost", "yes" if tracking.lost else "no"),
        ("speed", f"{figures['frames_per_second']:.3g} frames per second"),
    ):
        table.add_row(name, escape(value))
    return table


def _write(tracking: Tracking, figures: dict[str, Any], out: Path) -> None:
    write_json(out / "result.json", figures)
    write_text(out / "markers.csv", _markers(tracking))
    write_text(out / "hinges.csv", hinge_table(tracking))
    tracking.save(out / "poses.npz")
    picture = png(tracking.plot(), DPI)
    with replacing(out / "picture.png") as temporary:
        temporary.write_bytes(picture)


def _markers(tracking: Tracking) -> str:
    """Returns the marker positions [m] in the format of a recording's ``truth.csv``."""
    text = StringIO()
    writer = csv.writer(text, lineterminator="\n")
    writer.writerow(("frame", "joint", "x", "y", "z"))
    for frame, markers in zip(tracking.indices, tracking.markers, strict=True):
        for name, position in zip(tracking.joint_names, markers, strict=True):
            writer.writerow((frame, name, *(f"{value:.6f}" for value in position)))
    return text.getvalue()


def _finite(value: float | np.floating[Any]) -> float | None:
    return float(value) if math.isfinite(value) else None
