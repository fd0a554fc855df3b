"""The run through a recording behind ``register``, ``track`` and ``track_each``."""

from __future__ import annotations

from collections.abc import Iterator

from regkit.api.pipeline import Pipeline, begin
from regkit.api.tracking import Tracking, TrackingError
from regkit.interfaces import Recording
from regkit.observation import Frame
from regkit.system.errors import NoDataError, RegkitError
from regkit.system.optional import one_thread
from regkit.system.progress import is_shown
from regkit.system.progress import steps as progress_steps
from regkit.tracking import TrackedFrame, TrackRecorder, check_unit


def tracked_through(recording: Recording, pipeline: Pipeline, *, sized_in: int = 3) -> Tracking:
    """Returns the track of a body through a recording.

    Args:
        recording: The recording.
        pipeline: What tracks the body.
        sized_in: Number of frames that determine an unknown size.

    Raises:
        TrackingError: If a frame after the first cannot be read or registered.
        RegkitError: If the first frame cannot be registered.
    """
    recording.prepare()
    first = _first(recording)
    check_unit(first.points, pipeline.template, place=first.place or recording.name)
    session = pipeline.session(recording, sized_in)
    with one_thread():
        start = begin(session)
        registrar = pipeline.method.bind(start.body)
        recorder = TrackRecorder(registrar, recording.fps, session.observation)
        steps = session.tracked(registrar, pipeline.tracker, start.pose)
        failed = _record(recorder, _shown(steps, recording.length))
    tracking = Tracking.of(recording.name, pipeline.method_name, recording.fps, start, recorder)
    if failed is not None:
        raise TrackingError(failed.message, place=failed.place, tracked=tracking)
    return tracking


def _record(recorder: TrackRecorder, frames: Iterator[TrackedFrame]) -> RegkitError | None:
    """Records frames and returns the error that ended them early, if any frame was tracked.

    Raises:
        RegkitError: If the first frame fails.
    """
    try:
        for frame in frames:
            recorder.add(frame)
    except RegkitError as error:
        if not len(recorder):
            raise
        return error
    return None


def _first(recording: Recording) -> Frame:
    """Returns the first frame with points."""
    for frame in recording.frames():
        if len(frame.points):
            return frame
    raise NoDataError("no frame has a measurement", place=recording.name)


def _shown(steps: Iterator[TrackedFrame], length: int) -> Iterator[TrackedFrame]:
    """Yields the frames, with a progress bar on a terminal or in a notebook if there are many."""
    if is_shown():
        yield from steps if length < 2 else progress_steps(steps, "tracking", length)
        return
    from rich.console import Console
    from rich.progress import track as shown

    console = Console(stderr=True)
    quiet = length < 2 or not console.is_terminal
    yield from shown(
        steps, "tracking", total=length, console=console, transient=True, disable=quiet
    )
