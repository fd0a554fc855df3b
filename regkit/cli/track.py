"""``regkit track``."""

from __future__ import annotations

from dataclasses import replace
from enum import StrEnum
from pathlib import Path
from typing import Annotated

import typer

from regkit.api import track as track_frames
from regkit.api import track_each
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
from regkit.cli.verdicts import conclude
from regkit.interfaces import Dataset, Recording
from regkit.tracking import Verdict


class People(StrEnum):
    """How many bodies of a recording are tracked."""

    ONE = "one"
    ALL = "all"


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
    people: Annotated[
        People,
        typer.Option(help="Track one body, or all that fit in the first frame, each by itself."),
    ] = People.ONE,
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
    if people is People.ALL:
        _track_all(chosen, choices, name, results, as_json=as_json, strict=strict)
        return
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


def _track_all(
    recording: Recording, choices: Choices, method: str, out: Path, *, as_json: bool, strict: bool
) -> None:
    """Tracks every body, into folders within ``out`` if there are several.

    Raises:
        Exit: With ``NOT_FOUND``, if a body was lost, or is doubtful and ``strict`` is set.
    """
    found = track_each(
        recording,
        choices.template,
        choices.method,
        segmentation=choices.segmentation,
        preprocessor=choices.preprocessor,
        tracker=choices.tracker,
        start=choices.start,
    )
    for one in found:
        folder = out if len(found) == 1 else out / one.name
        show(replace(one, method=method), folder, as_json=as_json)
    verdicts = [one.verdict for one in found]
    worst = next(
        (one for one in (Verdict.LOST, Verdict.DOUBTFUL) if one in verdicts), Verdict.FOUND
    )
    reasons = [f"{one.name}: {one.judged.reason}" for one in found if one.judged.reason]
    conclude(worst, "; ".join(reasons), strict=strict)
