"""``regkit calibrate``."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import numpy as np
import typer
from rich.markup import escape
from rich.table import Table

from regkit.body.description import SizeDescription
from regkit.body.template_file import check_replaceable, write_template
from regkit.calibration import MarkerSet, MarkerSubject, Subject
from regkit.calibration.subject_shape import Changes, changed_proportions
from regkit.cli.calibration_source import Source
from regkit.cli.choices import segmentation_named
from regkit.cli.completion import plugin_names
from regkit.cli.console import errors, output
from regkit.cli.options import (
    PluginFiles,
    Segmentation,
    Strict,
    default_of,
    options,
    run_plugin_files,
)
from regkit.cli.verdicts import conclude
from regkit.config.document import Document
from regkit.interfaces import Recording, Template
from regkit.system.errors import ConfigError
from regkit.tracking import Verdict

OPENING = """\
Made by `regkit calibrate` from {frames} frames of {recording}. To use it:
template: {{kind: file, path: {file}}}

Lengths are in metres and angles in degrees."""

STRANGE = 0.05
"""Share of data far from the body above which a warning is printed."""

DOUBT = (
    "the data and the body cover each other only in part; parts without data keep the template's "
    "proportions"
)


def calibrate(
    source: Annotated[
        Path,
        typer.Argument(
            metavar="RECORDING",
            help="Folder or file of a recording, or an experiment's YAML file.",
            show_default=False,
        ),
    ],
    template: Annotated[
        str | None,
        typer.Option(
            metavar="TEMPLATE",
            autocompletion=plugin_names("template"),
            help="Body in the recording: a name such as hand, a template's YAML file, or a mapping "
            "such as '{kind: hand, side: left}'. "
            f"(default: the experiment's template, or {default_of('templates')})",
            show_default=False,
        ),
    ] = None,
    extrinsics: Annotated[
        bool,
        typer.Option(
            "--extrinsics",
            help="Find the poses of the recording's cameras instead, and write its cameras.json.",
        ),
    ] = False,
    base: Annotated[
        bool,
        typer.Option(
            "--base",
            help="Find the base of a robot that stands still instead, and write its template with "
            "the base fixed there, and the cameras' poses in its frame.",
        ),
    ] = False,
    up: Annotated[
        str | None,
        typer.Option(
            metavar="AXIS",
            help="With --base: upward axis of the robot's own frame, in which the cameras are "
            "told: z for the frame of a URDF file. (default: y, as in the template)",
            show_default=False,
        ),
    ] = None,
    front: Annotated[
        str | None,
        typer.Option(
            metavar="AXIS",
            help="With --base: forward axis of this frame: x for that of a URDF file. (default: z)",
            show_default=False,
        ),
    ] = None,
    out: Annotated[
        Path | None,
        typer.Option(
            metavar="FILE",
            help="File to write; an existing one is replaced. (default: subject.yaml, "
            "fixed_base.yaml, or the recording's cameras.json)",
            show_default=False,
        ),
    ] = None,
    recording: Annotated[
        str | None,
        typer.Option(metavar="NAME", help="Name of the recording, if there are several."),
    ] = None,
    frames: Annotated[
        int | None,
        typer.Option(
            min=1,
            metavar="N",
            help="Number of frames, spread over the recording. (default: 12, of cameras 40, of a "
            "base 30)",
            show_default=False,
        ),
    ] = None,
    markers: Annotated[
        Path | None,
        typer.Option(
            metavar="FILE",
            help="Marker set, with the rough places of the markers that a motion-capture system "
            "measured; the template gets them where they are.",
            show_default=False,
        ),
    ] = None,
    segmentation: Segmentation = None,
    settings: Annotated[
        list[str] | None,
        typer.Option(
            "--set",
            metavar="a.b.c=VALUE",
            help="Change a value of the experiment, such as dataset.frames=60. Repeatable.",
        ),
    ] = None,
    strict: Strict = False,
    plugin: PluginFiles = None,
) -> None:
    """Create a template with the body proportions of the person or hand in a recording.

    With ``--extrinsics``: find where several cameras are, from the body that moves before them.
    With ``--base``: find where a robot stands, from all frames together, and where the cameras are.
    """
    run_plugin_files(plugin)
    if base and (extrinsics or markers is not None):
        other = "--extrinsics" if extrinsics else "--markers"
        raise ConfigError("a calibration is of one kind; --base is another", place=other)
    for option, value in (("--up", up), ("--front", front)):
        if value is not None and not base:
            raise ConfigError("the axes are those of a robot's base; add --base", place=option)
    if extrinsics:
        from regkit.cli.calibrate_cameras import calibrate_cameras

        given = {"--recording": recording, "--set": settings}
        for option in (name for name, value in given.items() if value):
            raise ConfigError("--extrinsics takes the folder of one recording", place=option)
        calibrate_cameras(source, template, out, segmentation, frames, strict=strict)
        return
    out = out or Path("fixed_base.yaml" if base else "subject.yaml")
    check_replaceable(out)
    found = Source.read(source, template, settings or ())
    if segmentation is not None:
        found = found.model_copy(update={"segmentation": segmentation_named(segmentation)})
    seen = found.recording(recording)
    if base:
        from regkit.cli.calibrate_base import calibrate_base

        with options(up="--up", front="--front"):
            axes = (up or "y", front or "z")
            calibrate_base(found, seen, out, frames, axes, strict=strict)
        return
    frames = frames or 12
    if markers is not None:
        _by_markers(found.template, markers, seen, frames, out)
        return
    subject = found.calibration(frames).subject(seen)
    opening = OPENING.format(frames=subject.frames, recording=seen.name, file=out.name)
    write_template(out, subject.description, subject.skin, opening)
    _print_summary(subject)
    output.print(f"written: {out}")
    reason = "" if subject.verdict is Verdict.FOUND else DOUBT
    conclude(subject.verdict, reason, strict=strict)


def _by_markers(template: Template, markers: Path, seen: Recording, frames: int, out: Path) -> None:
    """Writes the template of a subject with markers."""
    document = Document.read(markers)
    chosen = document.validated(MarkerSet)
    chosen.check(template.description(), document)
    try:
        subject = MarkerSubject.of(template, chosen, seen, frames)
    except ConfigError as error:
        raise error.at(str(markers)) from None
    opening = OPENING.format(frames=subject.frames, recording=seen.name, file=out.name)
    skin = subject.proportions.skin(template.description())
    write_template(out, subject.description, skin, opening)
    size = subject.description.size
    scale = size.value / template.description().size.value
    _print_changes(size, changed_proportions(subject.proportions, scale))
    unseen = [name for name, error in zip(subject.names, subject.errors, strict=True)
              if not error >= 0.0]  # fmt: skip
    if unseen:
        errors.print(
            f"warning: the recording has no marker {', '.join(map(escape, unseen))}; it stays "
            "where the marker set has it",
            style="yellow",
        )
    mean = float(np.sqrt(np.nanmean(subject.errors**2)))
    output.print(
        f"the markers are {1000.0 * mean:.1f} mm from the measured ones (root mean square)"
    )
    output.print(f"written: {out}")


def _print_summary(subject: Subject) -> None:
    """Prints the size, shape and fit of the calibrated template."""
    _print_changes(subject.description.size, subject.shape.changes(subject.x))
    output.print(
        f"half of the data lies within {1000.0 * subject.distance:.1f} mm of the surface",
    )
    if subject.strange > STRANGE:
        errors.print(
            f"warning: {100.0 * subject.strange:.0f} % of the data is far from the body. Unless "
            "the frames show other objects, the body was not found: give its size, or use another "
            "recording",
            style="yellow",
        )


def _print_changes(size: SizeDescription, changes: Changes) -> None:
    """Prints the size, and a table of what a shape changes."""
    output.print(f"{size.name} {size.value:.4g} m; {changes.title}:")
    table = Table(changes.columns[0])
    for column in changes.columns[1:]:
        table.add_column(column, justify="right")
    for row in changes.rows:
        table.add_row(*map(escape, row))
    output.print(table)
