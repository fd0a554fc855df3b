"""``regkit align``."""

from __future__ import annotations

import json
import math
from pathlib import Path
from typing import Annotated, Any

import numpy as np
import typer
from rich.markup import escape
from rich.table import Table

from regkit.alignment import MIN_FITNESS, Alignment, judged
from regkit.alignment import align as align_clouds
from regkit.cli.align_all import align_views
from regkit.cli.choices import method_named, start_named
from regkit.cli.completion import plugin_names
from regkit.cli.console import errors, output
from regkit.cli.matrix import matrix_rows
from regkit.cli.options import PluginFiles, Strict, default_of, options, run_plugin_files
from regkit.cli.verdicts import conclude
from regkit.clouds import check_writable, read_cloud, write_cloud
from regkit.config.defaults import default_name
from regkit.interfaces import Method
from regkit.system.progress import working
from regkit.tracking import Verdict

FRAME = 24
"""Width of a table's borders and its column of names."""


def align(
    source: Annotated[
        Path,
        typer.Argument(
            metavar="SOURCE",
            help="Cloud or mesh to move: .ply .pcd .pts .xyz .npz .txt .csv .stl .obj ...",
            show_default=False,
        ),
    ],
    target: Annotated[
        Path,
        typer.Argument(
            metavar="TARGET", help="Cloud or mesh that stays fixed.", show_default=False
        ),
    ],
    more: Annotated[
        list[Path] | None,
        typer.Argument(metavar="[MORE]...", help="Further views, with --all.", show_default=False),
    ] = None,
    every: Annotated[
        bool,
        typer.Option(
            "--all",
            help="Align all views to one another, as of a turntable: T_world_view of each, in the "
            "frame of the first; --out writes the merged cloud.",
        ),
    ] = False,
    method: Annotated[
        str | None,
        typer.Option(
            metavar="METHOD",
            autocompletion=plugin_names("method"),
            help="Method: a preset or kind, such as open3d_icp, or a mapping such as "
            "'{kind: open3d_icp, estimation: generalized}'. "
            f"(default: {default_of('methods', 'rigid')})",
            show_default=False,
        ),
    ] = None,
    voxel: Annotated[
        float | None,
        typer.Option(
            min=0.0,
            metavar="METRES",
            help="Voxel size in metres for downsampling both clouds; 0 turns downsampling off. "
            "(default: chosen to keep about 5000 points)",
            show_default=False,
        ),
    ] = None,
    start: Annotated[
        str,
        typer.Option(
            metavar="START",
            help="Start: auto (any orientation), a plug-in such as features, rotations, "
            "open3d_features or kiss_matcher, or a mapping such as '{kind: features, points: "
            "[2000]}'; nearest (the better of identity and centroids), identity, centroids, or a "
            "file with a 4x4 matrix.",
        ),
    ] = "auto",
    out: Annotated[
        Path | None,
        typer.Option(metavar="FILE", help="Write the aligned source to this file."),
    ] = None,
    min_fitness: Annotated[
        float,
        typer.Option(
            min=0.0,
            max=1.0,
            metavar="SHARE",
            help="Fail if a smaller fraction of the source lies on the target.",
        ),
    ] = MIN_FITNESS,
    threads: Annotated[
        int | None,
        typer.Option(
            min=1,
            metavar="N",
            help="Number of threads, for clouds of many points; the result is the same. "
            "(default: 1, or what the method says)",
            show_default=False,
        ),
    ] = None,
    as_json: Annotated[bool, typer.Option("--json", help="Print the result as JSON.")] = False,
    strict: Strict = False,
    plugin: PluginFiles = None,
) -> None:
    """Align a cloud or mesh to another: T_target_source, and how well they match."""
    run_plugin_files(plugin)
    if out is not None:
        check_writable(out, place=f"--out {out}")
    name = default_name(Method.group, "rigid") if method is None else method
    chosen = method_named(name)
    begin = start_named(start)
    if every:
        with options(start="--start", voxel="--voxel", threads="--threads"):
            align_views(
                [source, target, *(more or [])], chosen,
                voxel=voxel, start=begin, threads=threads, out=out, as_json=as_json, strict=strict,
            )  # fmt: skip
        return
    if more:
        raise typer.BadParameter("more than two clouds need --all")
    points = read_cloud(source)
    resting = read_cloud(target)
    with options(start="--start", voxel="--voxel", threads="--threads"), working("aligning"):
        found = align_clouds(
            points,
            resting,
            chosen,
            voxel=voxel,
            start=begin,
            places=(str(source), str(target)),
            threads=threads,
        )
    verdict, reason = judged(found, min_fitness)
    if as_json:
        places = {"source": str(source), "target": str(target)}
        typer.echo(json.dumps(_figures(found, name, verdict) | places, indent=2, allow_nan=False))
    else:
        rows = matrix_rows(found.transform, points)
        fits = max(map(len, rows)) <= output.width - FRAME
        output.print(_table(found, name, rows if fits else ["below"]))
        if not fits:
            typer.echo("T_target_source\n" + "\n".join(rows))
    if out is not None and verdict is not Verdict.LOST:
        write_cloud(out, found.moved(points))
        errors.print(f"written: {out}")
    conclude(verdict, reason, strict=strict)


def _figures(found: Alignment, method: str, verdict: Verdict) -> dict[str, Any]:
    agreement = found.agreement
    rmse = agreement.inlier_rmse
    return {
        "T_target_source": found.transform.tolist(),
        "verdict": verdict,
        "fitness": agreement.fitness,
        "inlier_rmse": rmse if math.isfinite(rmse) else None,
        "overlap": agreement.overlap,
        "distance": agreement.distance,
        "fitness_at_start": found.before.fitness,
        "start": found.start,
        "hidden_motion": found.hidden,
        "covariance": found.covariance.tolist(),
        "displacement": found.displacement
        and dict(zip(("mean", "largest"), found.displacement, strict=True)),
        "rivals": [
            {
                "T_target_source": rival.transform.tolist(),
                "fitness": rival.agreement.fitness,
                "overlap": rival.agreement.overlap,
                "energy_difference": rival.energy if math.isfinite(rival.energy) else None,
            }
            for rival in found.rivals
        ],
        "method": method,
        "voxel": found.voxel,
        "points": list(found.points),
        "stray_points": list(found.stray),
        "seconds": found.seconds,
        "converged": found.converged,
        "message": found.message,
    }


def _stray(found: Alignment) -> str:
    shares = " and ".join(f"{100.0 * share:.1f} %" for share in found.stray)
    return f"{shares} are left out"


def _displaced(displacement: tuple[float, float]) -> str:
    mean, largest = displacement
    return f"{mean:.3g} on average, at most {largest:.3g}"


def _table(found: Alignment, method: str, matrix: list[str]) -> Table:
    agreement = found.agreement
    within = f"within {agreement.distance:.3g}"
    downsampled = "not downsampled" if found.voxel is None else f"voxels of {found.voxel:.3g}"
    table = Table(show_header=False)
    for name, value in (
        ("T_target_source", "\n".join(matrix)),
        ("fitness", f"{100 * agreement.fitness:.1f} % of the source {within} of the target"),
        ("", f"({100 * found.before.fitness:.1f} % at the start)"),
        ("inlier RMSE", f"{agreement.inlier_rmse:.4g}"),
        ("overlap", f"{100 * agreement.overlap:.1f} % of the target {within} of the source"),
        ("deviation", _deviation(found)),
        ("method", method),
        ("start", found.start),
        *([("deformation", _displaced(found.displacement))] if found.displacement else []),
        ("points", f"{found.points[0]} and {found.points[1]}, {downsampled}"),
        *([("stray points", _stray(found))] if any(found.stray) else []),
        ("seconds", f"{found.seconds:.2f}"),
        ("converged", f"{'yes' if found.converged else 'no'}: {found.message}"),
    ):
        table.add_row(name, escape(value))
    return table


def _deviation(found: Alignment) -> str:
    """Returns the standard deviations along and about the target's axes, in words."""
    shift, turn = found.deviations[:3], np.degrees(found.deviations[3:])
    return (
        ", ".join(f"{value:.2g}" for value in shift)
        + " of the source's centroid along x, y, z; "
        + ", ".join(f"{value:.2g}" for value in turn)
        + " degrees about them"
    )
