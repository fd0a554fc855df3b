"""The run of ``regkit track``: poses are written and shown as they come, to the end or Ctrl-C."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from contextlib import ExitStack, closing, nullcontext
from dataclasses import dataclass
from pathlib import Path
from typing import Any, Protocol

from regkit.api.live import live_track
from regkit.api.live_pose import LivePose
from regkit.api.live_track import LiveTrack
from regkit.api.pipeline import Pipeline
from regkit.cli.interrupt import Interrupt
from regkit.cli.out_folder import check_out
from regkit.cli.recording_tap import RecordingTap
from regkit.cli.status_line import StatusLine
from regkit.cli.track_files import remove_former
from regkit.interfaces import Start, Stream
from regkit.system.errors import RegkitError
from regkit.tracking.rows import RowsInFile
from regkit.tracking.track_folder import TrackDescription

STOPPING = "stopping after this frame"


class Output(Protocol):
    """What takes the poses of a track as they come."""

    def add(self, pose: LivePose, status: str) -> None:
        """Takes a pose, with the state of the track in words."""

    def close(self) -> None:
        """Ends the output."""


@dataclass(frozen=True)
class LiveRun:
    """How a stream is tracked by the command line.

    Attributes:
        source: Opens the stream.
        pipeline: What tracks the body.
        method: Name of the method.
        out: Folder of the results; ``tracks/NAME`` of the stream's name for None.
        opening: Duration in which the body is sought [s]; None for the default.
        every_frame: Whether every frame of a camera is tracked.
        realtime: Whether a recording is played at its own pace.
        record: New folder that takes the frames as a recording.
        outputs: Open what takes the poses, when the body is found.
        smooth: Whether what smoothing needs is kept.
    """

    source: Callable[[], Stream]
    pipeline: Pipeline
    method: str
    out: Path | None = None
    opening: float | None = None
    every_frame: bool = False
    realtime: bool = False
    record: Path | None = None
    outputs: Sequence[Callable[[LiveTrack], Output]] = ()
    smooth: bool = False

    def followed(self) -> Ended:
        """Tracks the stream to its end or to Ctrl-C.

        Raises:
            RegkitError: If the source cannot be opened, or no body comes into sight.
        """
        interrupt = Interrupt(STOPPING, checked=True)
        tap = None if self.record is None else RecordingTap(self.record)
        track = live_track(
            self.source,
            self.pipeline,
            opening=self.opening,
            every_frame=self.every_frame,
            realtime=self.realtime,
            rows=lambda start: self._rows(track, start),
            tap=tap,
            check=interrupt.check,
        )
        folder = self.folder(track)
        with track, tap or nullcontext():
            if tap is not None:
                tap.begin(track.stream)
            check_out(folder, whole=False)
            # The search for the body ends at Ctrl-C; from here on Ctrl-C ends the track.
            track.begin()
            with interrupt:
                error = self._poses(track, interrupt)
        return Ended(track, folder, error, interrupt.pressed)

    def folder(self, track: LiveTrack) -> Path:
        """Returns the folder of the results."""
        return self.out or Path("tracks") / track.name

    def _poses(self, track: LiveTrack, interrupt: Interrupt) -> RegkitError | None:
        """Passes on the poses; returns the error that ended the track early."""
        with ExitStack() as stack:
            line = stack.enter_context(StatusLine(track))
            opened = [stack.enter_context(closing(output(track))) for output in self.outputs]
            try:
                for pose in track:
                    status = line.add(pose)
                    for one in opened:
                        one.add(pose, status)
            except KeyboardInterrupt:
                interrupt.take_time()
            except RegkitError as error:
                return error
        return None

    def _rows(self, track: LiveTrack, start: Start) -> RowsInFile:
        """Keeps the frames on disk: memory does not grow, and a kill loses half a second."""
        about = (track.name, self.method, track.stream.fps, start.body.size)
        template = self.pipeline.template.chosen(extended=start.extended)
        description = TrackDescription.of(*about, template)
        remove_former(self.folder(track))
        return description.rows(self.folder(track), start.body, information=self.smooth)


@dataclass(frozen=True)
class Ended:
    """A track that has ended.

    Attributes:
        track: The track.
        folder: The folder of the results.
        error: What ended it early.
        interrupted: Whether Ctrl-C ended it.
    """

    track: LiveTrack
    folder: Path
    error: RegkitError | None
    interrupted: bool

    def figures(self) -> dict[str, Any]:
        """Returns what ``result.json`` holds of the stream."""
        track = self.track
        figures: dict[str, Any] = {"dropped_frames": track.dropped, "faults": dict(track.faults)}
        if track.is_live:
            figures["latency_ms"] = {
                f"p{percent}": round(1000.0 * track.latency(percent / 100.0), 3)
                for percent in (50, 99)
            }
        return figures
