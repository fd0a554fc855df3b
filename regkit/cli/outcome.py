"""Output of ``regkit register`` and ``regkit track``: a table, files, and an exit code."""

from __future__ import annotations

import json
from collections.abc import Mapping
from pathlib import Path
from typing import Any

import typer
from rich.console import Console
from rich.markup import escape
from rich.table import Table

from regkit.api import Tracking
from regkit.cli.console import errors, output
from regkit.cli.track_files import write_track
from regkit.cli.verdicts import conclude
from regkit.interfaces import Template
from regkit.metrics import in_words
from regkit.tracking import Verdict

OFTEN = 0.1
"""A segment is told if it has little data in such a fraction of the frames."""

SHOWN = 4
"""Maximum number of segments in the table."""


def finish(
    tracking: Tracking,
    template: Template,
    out: Path | None,
    *,
    as_json: bool,
    strict: bool,
    more: Mapping[str, Any] | None = None,
    rows: Mapping[str, str] | None = None,
) -> None:
    """Prints the result, writes it to a folder, and tells whether the body was found.

    Args:
        tracking: The result.
        template: The template of the body.
        out: The folder, if it is to be written.
        as_json: Whether to print JSON instead of a table.
        strict: Whether a doubtful result counts as not found.
        more: What else ``result.json`` holds.
        rows: What else the table shows, before the verdict.

    Raises:
        RegkitError: If a file cannot be written.
        Exit: With ``NOT_FOUND``, if the body was lost, or is doubtful and ``strict`` is set.
    """
    show(tracking, template, out, as_json=as_json, more=more, rows=rows)
    judged = tracking.judged
    conclude(judged.verdict, judged.reason, strict=strict)


def show(
    tracking: Tracking,
    template: Template,
    out: Path | None,
    *,
    as_json: bool,
    console: Console = output,
    more: Mapping[str, Any] | None = None,
    rows: Mapping[str, str] | None = None,
) -> None:
    """Prints the result and writes it to a folder.

    Args:
        tracking: The result.
        template: The template of the body.
        out: The folder, if it is to be written.
        as_json: Whether to print JSON instead of a table.
        console: Where the table is printed.
        more: What else ``result.json`` holds, of a stream or of a shape.
        rows: What else the table shows, before the verdict.

    Raises:
        RegkitError: If a file cannot be written.
    """
    figures = _figures(tracking) | dict(more or {})
    if as_json:
        typer.echo(json.dumps(figures, indent=2, allow_nan=False))
    else:
        console.print(_table(tracking, figures, rows or {}))
    if out is not None:
        write_track(out, tracking, template, figures)
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
        "smoothed": tracking.is_smoothed,
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


def _table(tracking: Tracking, figures: dict[str, Any], rows: Mapping[str, str]) -> Table:
    distance, fps = figures["surface_distance_mm"], figures["frames_per_second"]
    verdict = str(figures["verdict"])
    if len(tracking) > 1:
        verdict += f"; found in {figures['found_frames']} of {len(tracking)} frames"
    table = Table(show_header=False)
    for name, value in (
        ("frames", f"{tracking.name}, {len(tracking)}"),
        ("method", tracking.method + (", smoothed" if tracking.is_smoothed else "")),
        ("body", f"{tracking.body.name}, {tracking.size:.4g} m"),
        ("markers", str(len(tracking.joint_names))),
        ("surface distance", "-" if distance is None else f"{distance:.1f} mm (median)"),
        ("inliers", _percent(figures["inlier_share"], "the points")),
        ("covered", _percent(figures["coverage"], "the visible body has data")),
        ("little data", _told(figures["segments_with_little_data"])),
        ("converged", f"{figures['converged_frames']} of {len(tracking)}"),
        *rows.items(),
        ("verdict", verdict),
        ("stream", _stream(figures)),
        # The first frame includes the loading of data, so its speed says little.
        ("speed", "" if fps is None else in_words(fps)),
    ):
        if value and (name != "speed" or len(tracking) > 1):
            table.add_row(name, escape(value))
    return table


def _stream(figures: Mapping[str, Any]) -> str:
    """Returns what happened to the frames of a stream."""
    dropped, faults = figures.get("dropped_frames", 0), figures.get("faults", {})
    parts = [f"{dropped} frames dropped"] if dropped or "latency_ms" in figures else []
    parts += [f"{count} {fault}" for fault, count in faults.items()]
    if "latency_ms" in figures:
        latency = figures["latency_ms"]
        parts.append(f"latency {latency['p50']:.3g} ms (p99 {latency['p99']:.3g} ms)")
    return ", ".join(parts)


def _weak_segments(tracking: Tracking) -> dict[str, float]:
    """Returns the segments that often have little data, and in which fraction of the frames."""
    shares = zip(tracking.body.skeleton.names, tracking.track.weakly_seen.tolist(), strict=True)
    return {name: round(share, 3) for name, share in shares if share >= OFTEN}


def _told(weak: dict[str, float]) -> str:
    """Returns segments with little data in words, the worst first."""
    worst = sorted(weak, key=lambda name: -weak[name])
    told = [f"{name} in {100.0 * weak[name]:.0f} % of the frames" for name in worst[:SHOWN]]
    return ", ".join(told) + (f", and {len(worst) - SHOWN} more" if len(worst) > SHOWN else "")


def _share(percent: float | None) -> float | None:
    return None if percent is None else percent / 100.0


def _percent(share: float | None, of: str) -> str:
    return "-" if share is None else f"{100.0 * share:.0f} % of {of}"
