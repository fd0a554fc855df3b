"""``regkit align --all``: many views of one object in one frame."""

from __future__ import annotations

import json
from collections.abc import Sequence
from pathlib import Path
from typing import Any

import numpy as np
import typer
from rich.markup import escape
from rich.table import Table

from regkit.alignment import JointAlignment, align_all, judged, judged_all
from regkit.body.verdict import Verdict
from regkit.cli.console import errors, output
from regkit.cli.matrix import matrix_rows
from regkit.cli.verdicts import conclude
from regkit.clouds import read_cloud, write_cloud
from regkit.geometry.rigid import transformed
from regkit.interfaces import AlignmentStart, Method
from regkit.system.printable import printable
from regkit.system.progress import working


def align_views(
    files: Sequence[Path],
    method: Method,
    *,
    voxel: float | None,
    start: str | AlignmentStart,
    threads: int | None,
    out: Path | None,
    as_json: bool,
    strict: bool,
) -> None:
    """Aligns the views in files, prints T_world_view of each, and writes the merged cloud.

    Raises:
        RegkitError: If a file cannot be read, or a view cannot be aligned.
        Exit: If not all views are linked.
    """
    views = [read_cloud(file) for file in files]
    names = [str(file) for file in files]
    with working("aligning"):
        found = align_all(views, method, voxel=voxel, start=start, places=names, threads=threads)
    verdict, reason = judged_all(found, names)
    if as_json:
        figures = _figures(found, names) | {"verdict": verdict}
        typer.echo(json.dumps(figures, indent=2, allow_nan=False))
    else:
        output.print(_table(found, names))
        for name, pose, view in zip(names, found.transforms, views, strict=True):
            if np.isfinite(pose).all():
                typer.echo(
                    f"T_world_view of {printable(name)}\n" + "\n".join(matrix_rows(pose, view))
                )
    if out is not None and verdict is not Verdict.LOST:
        placed = zip(found.transforms, views, strict=True)
        write_cloud(out, np.concatenate([transformed(pose, view) for pose, view in placed]))
        errors.print(f"written: {out}")
    conclude(verdict, reason, strict=strict)


def _figures(found: JointAlignment, names: Sequence[str]) -> dict[str, Any]:
    return {
        "world": names[0],
        "T_world_view": {
            name: pose.tolist() if linked else None
            for name, pose, linked in zip(names, found.transforms, found.linked, strict=True)
        },
        "pairs": [
            {
                "source": names[pair.source],
                "target": names[pair.target],
                "T_target_source": pair.found.transform.tolist(),
                "fitness": pair.found.agreement.fitness,
                "overlap": pair.found.agreement.overlap,
                "verdict": judged(pair.found)[0],
                "kept": pair.kept,
            }
            for pair in found.pairs
        ],
    }


def _table(found: JointAlignment, names: Sequence[str]) -> Table:
    table = Table("view", "pairs", "greatest overlap")
    for index, name in enumerate(names):
        own = [one for one in found.pairs if one.kept and index in (one.source, one.target)]
        both = [0.5 * (one.found.agreement.fitness + one.found.agreement.overlap) for one in own]
        table.add_row(
            escape(name),
            str(len(own)) if found.linked[index] else "not linked",
            f"{100.0 * max(both, default=0.0):.0f} %",
        )
    return table
