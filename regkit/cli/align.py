"""``regkit align``."""

from __future__ import annotations

import json
import math
from pathlib import Path
from typing import Annotated, Any

import typer
from rich.markup import escape
from rich.table import Table

from regkit.alignment import Alignment
from regkit.alignment import align as align_clouds
from regkit.cli.choices import method_named
from regkit.cli.completion import plugin_names
from regkit.cli.console import errors, output
from regkit.cli.options import PluginFiles, options, run_plugin_files
from regkit.clouds import check_writable, read_cloud, write_cloud
from regkit.config.defaults import default_name
from regkit.geometry.rigid import transformed
from regkit.interfaces import Method
from regkit.system.progress import working


def align(
    source: Annotated[
        Path,
        typer.Argument(
            metavar="SOURCE",
            help="Cloud or mesh to move: .ply .pcd .xyz .npz .txt .csv .stl .obj ...",
            show_default=False,
        ),
    ],
    target: Annotated[
        Path,
        typer.Argument(
            metavar="TARGET", help="Cloud or mesh that stays fixed.", show_default=False
        ),
    ],
    method: Annotated[
        str | None,
        typer.Option(
            metavar="METHOD",
            autocompletion=plugin_names("method"),
            help="Method: a preset or kind, such as open3d_icp, or a mapping such as "
            "'{kind: open3d_icp, estimation: generalized}'. (default: rigid)",
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
            help="Initial transform: nearest (the better of identity and centroids), identity, "
            "centroids, rotations or features (both for any orientation), or a file with a 4x4 "
            "matrix.",
        ),
    ] = "nearest",
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
    ] = 0.3,
    as_json: Annotated[bool, typer.Option("--json", help="Print the result as JSON.")] = False,
    plugin: PluginFiles = None,
) -> None:
    """Align a rigid cloud or mesh to another: T_target_source, and how well they match."""
    run_plugin_files(plugin)
    if out is not None:
        check_writable(out, place=f"--out {out}")
    name = default_name(Method.group, "rigid") if method is None else method
    chosen = method_named(name)
    points = read_cloud(source)
    resting = read_cloud(target)
    with options(start="--start", voxel="--voxel"), working("aligning"):
        found = align_clouds(
            points, resting, chosen, voxel=voxel, start=start, places=(str(source), str(target))
        )
    aligned = found.agreement.fitness >= min_fitness
    if as_json:
        typer.echo(json.dumps(_figures(found, name, aligned), indent=2, allow_nan=False))
    else:
        output.print(_table(found, name))
    if found.hidden is not None:
        errors.print(
            f"warning: {found.hidden} of the source slides its surface along itself: that part of "
            "the transform is not determined by the data",
            style="yellow",
            highlight=False,
            soft_wrap=True,
        )
    if not aligned:
        errors.print(
            f"error: no alignment was found: {100.0 * found.agreement.fitness:.0f} % of the source "
            f"lies within {found.agreement.distance:.3g} of the target, and --min-fitness is "
            f"{min_fitness:g}; try --start rotations or --start features, and check that both "
            "clouds show the same object",
            style="red",
            highlight=False,
            soft_wrap=True,
        )
        raise typer.Exit(1)
    if out is not None:
        write_cloud(out, transformed(found.transform, points))
        errors.print(f"written: {out}", highlight=False, soft_wrap=True)


def _figures(found: Alignment, method: str, aligned: bool) -> dict[str, Any]:
    agreement = found.agreement
    rmse = agreement.inlier_rmse
    return {
        "T_target_source": found.transform.tolist(),
        "aligned": aligned,
        "fitness": agreement.fitness,
        "inlier_rmse": rmse if math.isfinite(rmse) else None,
        "overlap": agreement.overlap,
        "distance": agreement.distance,
        "fitness_at_start": found.before.fitness,
        "start": found.start,
        "hidden_motion": found.hidden,
        "method": method,
        "voxel": found.voxel,
        "points": list(found.points),
        "seconds": found.seconds,
        "converged": found.converged,
        "message": found.message,
    }


def _table(found: Alignment, method: str) -> Table:
    agreement = found.agreement
    within = f"within {agreement.distance:.3g}"
    downsampled = "not downsampled" if found.voxel is None else f"voxels of {found.voxel:.3g}"
    matrix = "\n".join(" ".join(f"{value:11.6f}" for value in row) for row in found.transform)
    table = Table(show_header=False)
    for name, value in (
        ("T_target_source", matrix),
        ("fitness", f"{100 * agreement.fitness:.1f} % of the source {within} of the target"),
        ("", f"({100 * found.before.fitness:.1f} % at the start)"),
        ("inlier RMSE", f"{agreement.inlier_rmse:.4g}"),
        ("overlap", f"{100 * agreement.overlap:.1f} % of the target {within} of the source"),
        ("method", method),
        ("start", found.start),
        ("points", f"{found.points[0]} and {found.points[1]}, {downsampled}"),
        ("seconds", f"{found.seconds:.2f}"),
        ("converged", f"{'yes' if found.converged else 'no'}: {found.message}"),
    ):
        table.add_row(name, escape(value))
    return table
