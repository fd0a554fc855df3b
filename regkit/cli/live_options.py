"""Options of ``regkit track``: the stream, how it is tracked, and where the poses go."""

from __future__ import annotations

from enum import StrEnum
from pathlib import Path
from typing import Annotated

import typer

from regkit.cli.completion import plugin_names
from regkit.tracking.live import OPENING, RECORDED_OPENING


class People(StrEnum):
    """How many bodies of a recording are tracked."""

    ONE = "one"
    ALL = "all"


TrackerName = Annotated[
    str | None,
    typer.Option(
        metavar="TRACKER",
        autocompletion=plugin_names("tracker"),
        help="Tracker from frame to frame, if the method has none of its own.",
        show_default=False,
    ),
]

RecordingName = Annotated[
    str | None,
    typer.Option(metavar="NAME", help="Name of the recording, if the folder has several."),
]

Frames = Annotated[
    int | None, typer.Option(min=1, metavar="N", help="Track only the first N frames.")
]

KeypointFile = Annotated[
    Path | None,
    typer.Option(
        "--keypoints",
        metavar="FILE",
        help="Keypoints of the frames: a .csv file, a .json file of MediaPipe, or a folder of "
        "OpenPose's files.",
        show_default=False,
    ),
]

Opening = Annotated[
    float | None,
    typer.Option(
        metavar="SECONDS",
        help="Duration in which the body, its size and its surroundings are sought. (default: "
        f"{OPENING} for a camera, {RECORDED_OPENING} for a recording)",
        show_default=False,
    ),
]

EveryFrame = Annotated[
    bool,
    typer.Option(
        "--every-frame", help="Track every frame of a camera, however late, and drop none."
    ),
]

Realtime = Annotated[
    bool, typer.Option("--realtime", help="Play a recording at its own pace, as a camera.")
]

View = Annotated[
    bool, typer.Option("--view", help="Show the body in a browser while it is tracked.")
]

Host = Annotated[str, typer.Option(metavar="ADDRESS", help="Address on which --view listens.")]

Port = Annotated[
    int,
    typer.Option(min=0, max=65535, metavar="N", help="Port of --view; 0 for a free one."),
]

Record = Annotated[
    Path | None,
    typer.Option(
        metavar="DIR",
        help="Record all frames, also those that are dropped, into this new folder.",
        show_default=False,
    ),
]

Smooth = Annotated[
    bool,
    typer.Option(
        "--smooth",
        help="Smooth the motion when it is tracked: hidden limbs and frames without data are "
        "interpolated, and noise is less.",
    ),
]

TrackOut = Annotated[
    str | None,
    typer.Option(
        metavar="FOLDER|FILE|-",
        help="Folder for the results: result.json, markers.csv, deviations.csv, hinges.csv, "
        "frames.csv, poses.npz and picture.png; or a file .csv or .jsonl, or - for standard "
        "output, that takes each pose as it comes. (default: tracks/RECORDING)",
        show_default=False,
    ),
]

Bodies = Annotated[
    People,
    typer.Option(help="Track one body, or all that fit in the first frame, each by itself."),
]
