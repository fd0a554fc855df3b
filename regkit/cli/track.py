"""``regkit track``."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path
from typing import Annotated

import typer

from regkit.api import track as track_frames
from regkit.api.tracking import TrackingError
from regkit.cli.choices import Choices
from regkit.cli.completion import plugin_names
from regkit.cli.options import (
    MethodName,
    PluginFiles,
    PreprocessorName,
    Segmentation,
    Settings,
    Strict,
    TemplateName,
    options,
    run_plugin_files,
)
from regkit.cli.out_folder import check_out
from regkit.cli.outcome import finish, show
from regkit.interfaces import Dataset


def track(
    folder: Annotated[
        Path,
        typer.Argument(
            metavar="FOLDER",
            help="Folder of a recording: depth/ or clouds/ beside a sequence.yaml.",
            show_default=False,
        ),
    ],
    template: TemplateName = None,
    method: MethodName = None,
    segmentation: Segmentation = None,
    preprocessor: PreprocessorName = None,
    tracker: Annotated[
        str | None,
        typer.Option(
            metavar="TRACKER",
            autocompletion=plugin_names("tracker"),
            help="Tracker from frame to frame, if the method has none of its own.",
            show_default=False,
        ),
    ] = None,
    recording: Annotated[
        str | None,
        typer.Option(metavar="NAME", help="Name of the recording, if the folder has several."),
    ] = None,
    frames: Annotated[
        int | None, typer.Option(min=1, metavar="N", help="Track only the first N frames.")
    ] = None,
    settings: Settings = None,
    out: Annotated[
        Path | None,
        typer.Option(
            metavar="FOLDER",
            help="Folder for result.json, markers.csv, hinges.csv, frames.csv, poses.npz and "
            "picture.png. "
            "(default: tracks/RECORDING)",
            show_default=False,
        ),
    ] = None,
    as_json: Annotated[bool, typer.Option("--json", help="Print the result as JSON.")] = False,
    strict: Strict = False,
    plugin: PluginFiles = None,
) -> None:
    """Track a template through a recording; the first frame's pose is found automatically."""
    run_plugin_files(plugin)
    named = {"template": template, "method": method, "preprocessor": preprocessor}
    choices, name = Choices.of(
        {**named, "segmentation": segmentation, "tracker": tracker}, settings or ()
    )
    data = Dataset.in_folder(folder, frames=frames)
    with options(**{"dataset.recordings": "--recording"}):
        chosen = Dataset.parse(data, place="FOLDER", field="dataset").only(recording)
    results = out or Path("tracks") / chosen.name
    check_out(results, whole=False)
    try:
        found = track_frames(
            chosen,
            choices.template,
            choices.method,
            segmentation=choices.segmentation,
            preprocessor=choices.preprocessor,
            tracker=choices.tracker,
            start=choices.start,
        )
    except TrackingError as error:
        # What was tracked before the damaged frame is kept; the error decides the exit code.
        if error.tracked is not None:
            show(replace(error.tracked, method=name), results, as_json=as_json)
        raise
    finish(replace(found, method=name), results, as_json=as_json, strict=strict)
