"""``regkit track``."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from pathlib import Path
from typing import Annotated

import typer

from regkit.api import Tracking, track_each
from regkit.api.live_track import LiveTrack
from regkit.api.pipeline import Pipeline
from regkit.cli.choices import Choices
from regkit.cli.console import errors, output
from regkit.cli.exit_codes import INTERRUPTED
from regkit.cli.live_options import (
    Bodies,
    EveryFrame,
    Frames,
    Host,
    KeypointFile,
    Opening,
    People,
    Port,
    Realtime,
    Record,
    RecordingName,
    Smooth,
    TrackerName,
    TrackOut,
    View,
)
from regkit.cli.live_run import Ended, LiveRun, Output
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
from regkit.cli.outcome import show
from regkit.cli.pose_stream import SUFFIXES, PoseOutput, is_pose_stream
from regkit.cli.track_source import dataset_recording, described, opener
from regkit.cli.verdicts import conclude
from regkit.cli.view_output import ViewOutput
from regkit.interchange.motions import FORMATS
from regkit.interfaces import Recording
from regkit.system.errors import ConfigError, NoDataError, RegkitError
from regkit.tracking import Verdict
from regkit.viewer.animation.film import FORMATS as FILMS
from regkit.viewer.server import HOST


def track(
    source: Annotated[
        str,
        typer.Argument(
            metavar="SOURCE",
            help="Folder or file of a recording, or a camera such as realsense:",
            show_default=False,
        ),
    ],
    template: TemplateName = None,
    method: MethodName = None,
    segmentation: Segmentation = None,
    preprocessor: PreprocessorName = None,
    tracker: TrackerName = None,
    recording: RecordingName = None,
    frames: Frames = None,
    keypoints: KeypointFile = None,
    opening: Opening = None,
    every_frame: EveryFrame = False,
    realtime: Realtime = False,
    view: View = False,
    host: Host = HOST,
    port: Port = 0,
    record: Record = None,
    people: Bodies = People.ONE,
    smooth: Smooth = False,
    settings: Settings = None,
    out: TrackOut = None,
    as_json: Annotated[bool, typer.Option("--json", help="Print the result as JSON.")] = False,
    strict: Strict = False,
    plugin: PluginFiles = None,
) -> None:
    """Track a template through a camera's stream or a recording, from the first frames on.

    Ctrl-C ends the tracking; what was tracked is kept.
    """
    run_plugin_files(plugin)
    named = {"template": template, "method": method, "preprocessor": preprocessor}
    named |= {"segmentation": segmentation, "tracker": tracker}
    data = described(source, recording)
    choices, name = Choices.of(named, settings or (), data)
    stream = out if out is not None and is_pose_stream(out) else None
    folder = None if out is None or stream is not None else _folder(Path(out))
    if stream == "-" and as_json:
        raise ConfigError("standard output takes the poses; leave one of both out", place="--json")
    if smooth and stream is not None:
        raise ConfigError(
            "poses that are written as they come cannot be smoothed; name a folder",
            place="--smooth",
        )
    if people is People.ALL:
        alone = {"--view": view, "--record": record, "--realtime": realtime, "--out": stream}
        for option in (one for one, given in alone.items() if given):
            raise ConfigError("all people are tracked one by one, not live", place=option)
        chosen = dataset_recording(source, recording, frames, keypoints)
        folder = folder or Path("tracks") / chosen.name
        check_out(folder, whole=False)
        _track_all(chosen, choices, name, folder, smooth=smooth, as_json=as_json, strict=strict)
        return
    outputs: list[Callable[[LiveTrack], Output]] = []
    if stream is not None:
        outputs.append(lambda track: PoseOutput(stream, track.body))
    if view:
        outputs.append(lambda track: ViewOutput(track, name, host, port))
    run = LiveRun(
        opener(source, choices.source, recording, frames, keypoints),
        _pipeline(choices),
        name,
        folder,
        opening=opening,
        every_frame=every_frame,
        realtime=realtime,
        record=record,
        outputs=outputs,
        smooth=smooth,
    )
    ended = run.followed()
    tracking = replace(_tracked(ended), method=name)
    if smooth:
        tracking, unsmoothed = _smoothed(tracking)
    else:
        unsmoothed = None
    shown = errors if stream == "-" else output
    show(
        tracking, choices.template, ended.folder, as_json=as_json, console=shown,
        more=ended.figures(),
    )  # fmt: skip
    for error in (ended.error, unsmoothed):
        if error is not None:
            raise error
    if ended.interrupted and not ended.track.stream.live:
        raise typer.Exit(INTERRUPTED)
    conclude(tracking.judged.verdict, tracking.judged.reason, strict=strict)


def _pipeline(choices: Choices) -> Pipeline:
    return Pipeline.of(
        choices.template,
        choices.method,
        choices.segmentation,
        choices.preprocessor,
        choices.tracker,
        choices.start,
        place="regkit track",
    )


def _folder(out: Path) -> Path:
    """Returns the folder of the results.

    Raises:
        ConfigError: If it is named as the file of an export, and not there.
    """
    if out.suffix.lower() in (*FORMATS, *FILMS) and not out.is_dir():
        raise ConfigError(
            f"'{out.suffix}' is a format of `regkit export`; name a folder, or a file "
            f"{' or '.join(SUFFIXES)}, and export the track then",
            place=f"--out {out}",
        )
    return out


def _tracked(ended: Ended) -> Tracking:
    """Returns what was tracked.

    Raises:
        RegkitError: What ended the track before its first frame.
        Exit: If Ctrl-C did.
    """
    try:
        return ended.track.tracking()
    except NoDataError as error:
        if ended.interrupted:
            raise typer.Exit(INTERRUPTED) from None
        raise ended.error or error from None


def _smoothed(tracking: Tracking) -> tuple[Tracking, RegkitError | None]:
    """Returns the smoothed motion, or the tracked one and why it cannot be smoothed."""
    try:
        with options(smooth="--smooth"):
            return tracking.smoothed(), None
    except RegkitError as error:
        return tracking, error


def _track_all(
    recording: Recording,
    choices: Choices,
    method: str,
    out: Path,
    *,
    smooth: bool,
    as_json: bool,
    strict: bool,
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
    for each in found:
        one, unsmoothed = _smoothed(each) if smooth else (each, None)
        folder = out if len(found) == 1 else out / one.name
        show(replace(one, method=method), choices.template, folder, as_json=as_json)
        if unsmoothed is not None:
            raise unsmoothed
    verdicts = [one.verdict for one in found]
    worst = next(
        (one for one in (Verdict.LOST, Verdict.DOUBTFUL) if one in verdicts), Verdict.FOUND
    )
    reasons = [f"{one.name}: {one.judged.reason}" for one in found if one.judged.reason]
    conclude(worst, "; ".join(reasons), strict=strict)
