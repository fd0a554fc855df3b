"""``regkit preview``."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer
from rich.table import Table

from regkit.api.previewing import Preview
from regkit.api.previewing import preview as preview_frames
from regkit.cli.calibration_source import Source
from regkit.cli.choices import segmentation_named
from regkit.cli.console import output
from regkit.cli.options import PluginFiles, Segmentation, TemplateName, run_plugin_files
from regkit.cli.verdicts import conclude
from regkit.system.errors import ConfigError
from regkit.tracking import Verdict


def preview(
    source: Annotated[
        Path,
        typer.Argument(
            metavar="RECORDING",
            help="Folder or file of a recording, or an experiment's YAML file.",
            show_default=False,
        ),
    ],
    template: TemplateName = None,
    segmentation: Segmentation = None,
    recording: Annotated[
        str | None,
        typer.Option(metavar="NAME", help="Name of the recording, if there are several."),
    ] = None,
    frames: Annotated[
        int,
        typer.Option(min=1, max=50, metavar="N", help="Number of frames, spread over it."),
    ] = 4,
    settings: Annotated[
        list[str] | None,
        typer.Option(
            "--set",
            metavar="a.b.c=VALUE",
            help="Change a value of the experiment, such as dataset.frames=60. Repeatable.",
        ),
    ] = None,
    out: Annotated[
        Path, typer.Option(metavar="FILE", help="PNG picture to write; it is replaced.")
    ] = Path("preview.png"),
    plugin: PluginFiles = None,
) -> None:
    """Show what the segmentation removes from a recording, and what it leaves of it."""
    run_plugin_files(plugin)
    if out.suffix.lower() != ".png":
        raise ConfigError(f"'{out}' must end with .png", place="--out")
    found = Source.read(source, template, settings or ())
    chosen = found.segmentation
    if segmentation is not None:
        chosen = segmentation_named(segmentation)
    shown = preview_frames(
        found.recording(recording), found.template, segmentation=chosen, count=frames
    )
    output.print(_table(shown))
    shown.save(out)
    output.print(f"written: {out}")
    reason = "no point is left in any frame that is shown" if shown.is_empty else ""
    conclude(Verdict.LOST if shown.is_empty else Verdict.FOUND, reason, strict=False)


def _table(shown: Preview) -> Table:
    """Returns a table of the points that each step removes, by frame."""
    table = Table("frame", title=shown.name)
    for name in ("points", *(f"{step} removes" for step in shown.steps), "kept"):
        table.add_column(name, justify="right")
    for frame in shown.frames:
        table.add_row(str(frame.index), str(len(frame.whole.points)), *map(str, frame.counts))
    return table
