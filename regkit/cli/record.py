"""``regkit record``."""

from __future__ import annotations

import time
from pathlib import Path
from typing import Annotated

import typer

from regkit.cli.console import errors, output
from regkit.cli.exit_codes import INTERRUPTED
from regkit.cli.interrupt import Interrupt
from regkit.cli.options import PluginFiles, run_plugin_files
from regkit.cli.progress import display
from regkit.cli.source_address import source_at
from regkit.interfaces import Stream
from regkit.recording import FolderWriter
from regkit.recording.writer import check_new
from regkit.system.errors import DataError

SHOWN = 5
"""Number of damaged frames that are told one by one."""


def record(
    source: Annotated[
        str,
        typer.Argument(
            metavar="SOURCE",
            help="Camera, such as realsense:, or recording: a bag of ROS (.bag, .db3, .mcap or its "
            "folder), a recording of a camera, or a folder.",
            show_default=False,
        ),
    ],
    folder: Annotated[
        Path,
        typer.Argument(metavar="DIR", help="New folder for the recording.", show_default=False),
    ],
    frames: Annotated[
        int | None,
        typer.Option(min=1, metavar="N", help="End after this number of frames."),
    ] = None,
    seconds: Annotated[
        float | None,
        typer.Option(min=0.0, metavar="S", help="End after this time, on the source's clock."),
    ] = None,
    settings: Annotated[
        list[str] | None,
        typer.Option(
            "--set",
            metavar="FIELD=VALUE",
            help="Set a field of the source, such as topic=/camera/depth/image_raw or width=640; "
            "'regkit plugins KIND' lists them. Repeatable.",
        ),
    ] = None,
    plugin: PluginFiles = None,
) -> None:
    """Record the depth images of a camera, or of a file, as a folder that regkit reads."""
    run_plugin_files(plugin)
    chosen = source_at(source, settings or ())
    # The folder is refused before a camera starts.
    check_new(folder)
    with Interrupt("ending the recording", checked=True) as interrupt, chosen.open() as stream:
        name = folder.absolute().name
        interrupt.last_words = f"what was recorded is in {folder}"
        with FolderWriter(folder, name, stream.fps, stream.depth_scale, source=source) as writer:
            recorder = Recorder(stream, writer, frames, seconds)
            try:
                recorder.run(interrupt)
            finally:
                recorder.tell()
    if interrupt.pressed:
        raise typer.Exit(INTERRUPTED)
    if not writer.count:
        raise DataError("no frame could be recorded", place=source)


class Recorder:
    """Records a stream until it ends, or a limit or Ctrl-C ends it."""

    def __init__(
        self, stream: Stream, writer: FolderWriter, frames: int | None, seconds: float | None
    ) -> None:
        self._stream, self._writer = stream, writer
        self._frames = frames
        self._seconds = float("inf") if seconds is None else seconds
        self._damaged = 0
        self._first: float | None = None
        self._began: float | None = None

    def run(self, interrupt: Interrupt) -> None:
        """Records, and shows the progress.

        Raises:
            RegkitError: If the source is lost, its camera changes, or the folder cannot be written.
        """
        total = self._stream.length if self._frames is None else self._frames
        task = display.begin(self._progress(), total)
        try:
            while not interrupt.pressed and self._writer.count != self._frames:
                try:
                    timed = self._stream.read()
                except DataError as error:
                    self._tell_damaged(error)
                    continue
                if timed is None or self._is_over(timed.time):
                    break
                # The rate leaves out the time until a camera yields its first frame.
                self._began = self._began or time.monotonic()
                self._writer.add(timed)
                display.describe(task, self._progress())
                display.advance(task)
        finally:
            display.end(task)

    def _is_over(self, at: float) -> bool:
        """Returns whether the time of a frame [s] is beyond the limit."""
        self._first = at if self._first is None else self._first
        return at - self._first >= self._seconds

    def _tell_damaged(self, error: DataError) -> None:
        self._damaged += 1
        if self._damaged <= SHOWN:
            errors.print(f"warning: left out: {error}", style="yellow")

    def tell(self) -> None:
        """Prints what was recorded."""
        if self._writer.count:
            output.print(f"recorded: {self._state()}, in {self._writer.folder}")

    def _progress(self) -> str:
        return f"recording {self._stream.name}: {self._state()}"

    def _state(self) -> str:
        count = self._writer.count
        elapsed = 0.0 if self._began is None else time.monotonic() - self._began
        rate = count / elapsed if elapsed > 0.0 else 0.0
        parts = [f"{count} frames", f"{rate:.1f} per second", f"{self._stream.dropped} dropped"]
        if self._damaged:
            parts.append(f"{self._damaged} damaged")
        return ", ".join(parts)
