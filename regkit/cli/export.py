"""``regkit export``."""

from __future__ import annotations

from enum import StrEnum
from pathlib import Path
from typing import Annotated

import typer

from regkit.cli.console import output
from regkit.cli.options import PluginFiles, options, run_plugin_files
from regkit.experiment.tracked_motion import read_tracked_motion
from regkit.experiment.viewing import read_track
from regkit.interchange.motions import FORMATS, write_motion
from regkit.system.errors import ConfigError
from regkit.tracking.track_folder import TrackDescription, is_track_folder
from regkit.viewer.animation.film import FORMATS as FILMS
from regkit.viewer.animation.film import write_film


class Unit(StrEnum):
    """Unit of length of a BVH file."""

    M = "m"
    CM = "cm"


def export(
    results: Annotated[
        Path,
        typer.Argument(
            metavar="TRACK",
            help="Folder of a track: RESULTS/METHOD/RECORDING of `regkit run`, or that of `regkit "
            "track`.",
            show_default=False,
        ),
    ],
    to: Annotated[
        Path,
        typer.Option(
            metavar="FILE",
            help="File to write: .bvh, .csv or .glb, or the animated picture .gif or .webp; an "
            "existing one is replaced.",
            show_default=False,
        ),
    ],
    unit: Annotated[Unit, typer.Option(help="Unit of length of a .bvh file.")] = Unit.M,
    fps: Annotated[
        float | None,
        typer.Option(help="Frames per second. (default: the recording's)", show_default=False),
    ] = None,
    plugin: PluginFiles = None,
) -> None:
    """Export a tracked motion: BVH, CSV or glTF, or an animated picture."""
    run_plugin_files(plugin)
    known = (*FORMATS, *FILMS)
    if to.suffix.lower() not in known:
        raise ConfigError(
            f"'{to.suffix}' is not an export format ({', '.join(known)})", place="--to"
        )
    if fps is not None and not 0.0 < fps < float("inf"):
        raise ConfigError(f"{fps:g} frames per second; it must be positive", place="--fps")
    if to.suffix.lower() in FILMS:
        _export_film(results, to, fps)
        return
    with options(fps="--fps"):
        if is_track_folder(results):
            motion = TrackDescription.read(results).motion(results, fps)
        else:
            motion = read_tracked_motion(results, fps)
    write_motion(motion, to, scale=0.01 if unit is Unit.CM else 1.0)
    output.print(
        f"written: {to} (frames: {len(motion.transforms)}, {motion.fps:g} per second; "
        f"segments: {len(motion.body.skeleton.names)})",
    )


def _export_film(folder: Path, to: Path, fps: float | None) -> None:
    """Writes the animated picture of a track, of a run or of ``regkit track``."""
    film = write_film(read_track(folder).track, to, fps)
    left_out = "" if film.frames == film.length else f" of {film.length}"
    output.print(
        f"written: {to} (frames: {film.frames}{left_out}, {film.seconds:.2g} s, "
        f"{film.size / 1e6:.1f} MB)"
    )
