"""Output of ``regkit register`` and ``regkit track``: a table, files, and an exit code."""

from __future__ import annotations

import json
import math
from pathlib import Path
from typing import Any

import typer
from rich.markup import escape
from rich.table import Table

from regkit.api import Tracking
from regkit.api.viewing import scene_of
from regkit.cli.console import errors, output
from regkit.cli.hinge_table import hinge_table
from regkit.cli.verdicts import conclude
from regkit.report.png import png
from regkit.system.csv_table import csv_text
from regkit.system.files import replacing, write_text
from regkit.system.json_files import write_json
from regkit.tracking import Verdict
from regkit.viewer.track_file import write_scene

DPI = 110

OFTEN = 0.1
"""A segment is told if it has little data in such a fraction of the frames."""

SHOWN = 4
"""Maximum number of segments in the table."""


def finish(tracking: Tracking, out: Path | None, *, as_json: bool, strict: bool) -> None:
    """Prints the result, writes it to a folder, and tells whether the body was found.

    Raises:
        RegkitError: If a file cannot be written.
        Exit: With ``NOT_FOUND``, if the body was lost, or is doubtful and ``strict`` is set.
    """
    show(tracking, out, as_json=as_json)
    judged = tracking.judged
    conclude(judged.verdict, judged.reason, strict=strict)


def show(tracking: Tracking, out: Path | None, *, as_json: bool) -> None:
    """Prints the result and writes it to a folder.

    Raises:
        RegkitError: If a file cannot be written.
    """
    figures = _figures(tracking)
    if as_json:
        typer.echo(json.dumps(figures, indent=2, allow_nan=False))
    else:
        output.print(_table(tracking, figures))
    if out is not None:
        _write(tracking, figures, out)
        errors.print(f"written: {out}")


def _figures(tracking: Tracking) -> dict[str, Any]:
    """Returns the content of ``result.json``, with the pose for a single frame."""
    track, judged = tracking.track, tracking.judged
    measure = tracking.measure()
    figures: dict[str, Any] = {
        "verdict": judged.verdict,
        "reason": judged.reason or None,
        "frames": len(tracking),
        **{
            f"{verdict.replace(' ', '_')}_frames": track.verdicts.count(verdict)
            for verdict in Verdict
        },
        "converged_frames": int(track.converged.sum()),
        "template": tracking.body.name,
        "size": tracking.size,
        "method": tracking.method,
        "surface_distance_mm": measure.surface_distance_mm,
        "inlier_share": _share(measure.inlier_percent),
        "coverage": _share(measure.coverage_percent),
        "segments_with_little_data": _weak_segments(tracking),
        "frames_per_second": measure.fps,
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
    distance, fps = figures["surface_distance_mm"], figures["frames_per_second"]
    verdict = str(figures["verdict"])
    if len(tracking) > 1:
        verdict += f"; found in {figures['found_frames']} of {len(tracking)} frames"
    table = Table(show_header=False)
    for name, value in (
        ("frames", f"{tracking.name}, {len(tracking)}"),
        ("method", tracking.method),
        ("body", f"{tracking.body.name}, {tracking.size:.4g} m"),
        ("markers", str(len(tracking.joint_names))),
        ("surface distance", "-" if distance is None else f"{distance:.1f} mm (median)"),
        ("inliers", _percent(figures["inlier_share"], "the points")),
        ("covered", _percent(figures["coverage"], "the visible body has data")),
        ("little data", _told(figures["segments_with_little_data"])),
        ("converged", f"{figures['converged_frames']} of {len(tracking)}"),
        ("verdict", verdict),
        # The first frame includes the loading of data, so its speed says little.
        ("speed", "" if fps is None else f"{fps:.3g} frames per second"),
    ):
        if value and (name != "speed" or len(tracking) > 1):
            table.add_row(name, escape(value))
    return table


def _weak_segments(tracking: Tracking) -> dict[str, float]:
    """Returns the segments that often have little data, and in which fraction of the frames."""
    shares = zip(tracking.body.skeleton.names, tracking.track.weakly_seen.tolist(), strict=True)
    return {name: round(share, 3) for name, share in shares if share >= OFTEN}


def _told(weak: dict[str, float]) -> str:
    """Returns segments with little data in words, the worst first."""
    worst = sorted(weak, key=lambda name: -weak[name])
    told = [f"{name} in {100.0 * weak[name]:.0f} % of the frames" for name in worst[:SHOWN]]
    return ", ".join(told) + (f", and {len(worst) - SHOWN} more" if len(worst) > SHOWN else "")


def _write(tracking: Tracking, figures: dict[str, Any], out: Path) -> None:
    write_json(out / "result.json", figures)
    write_text(out / "markers.csv", _markers(tracking))
    write_text(out / "hinges.csv", hinge_table(tracking))
    write_text(out / "frames.csv", _frames(tracking))
    tracking.save(out / "poses.npz")
    write_scene(scene_of(tracking), out)
    picture = png(tracking.plot(), DPI)
    with replacing(out / "picture.png") as temporary:
        temporary.write_bytes(picture)


def _markers(tracking: Tracking) -> str:
    """Returns the marker positions [m] in the format of a recording's ``truth.csv``."""
    return csv_text(
        ("frame", "joint", "x", "y", "z"),
        [
            (frame, name, *(f"{value:.6f}" for value in position))
            for frame, markers in zip(tracking.indices, tracking.markers, strict=True)
            for name, position in zip(tracking.joint_names, markers, strict=True)
        ],
    )


def _frames(tracking: Tracking) -> str:
    """Returns a table of the frames: verdict, agreement with the data, and cost."""
    track = tracking.track
    columns = ("inlier_shares", "coverages", "misfits", "reliefs", "surface_distances")
    shares = [
        [f"{value:.6g}" if math.isfinite(value) else "" for value in row]
        for row in zip(*(getattr(track, name) for name in columns), strict=True)
    ]
    return csv_text(
        ("frame", "time_s", "verdict", "points", "inlier_share", "coverage", "misfit", "relief",
         "surface_distance_m", "converged", "seconds"),
        [
            (frame, f"{frame / tracking.fps:.6f}", track.verdicts[at], int(track.points[at]),
             *shares[at], int(track.converged[at]), f"{track.seconds[at]:.6f}")
            for at, frame in enumerate(tracking.indices)
        ],
    )  # fmt: skip


def _share(percent: float | None) -> float | None:
    return None if percent is None else percent / 100.0


def _percent(share: float | None, of: str) -> str:
    return "-" if share is None else f"{100.0 * share:.0f} % of {of}"
