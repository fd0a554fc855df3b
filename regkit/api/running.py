"""The run through a recording behind ``register``, ``track`` and ``track_each``."""

from __future__ import annotations

from collections.abc import Iterator

from regkit.api.choices import Choice, Choices, load_template, name_of, segmenters_of
from regkit.api.tracking import Tracking, TrackingError
from regkit.clouds import spacing, voxel_for
from regkit.interfaces import (
    Method,
    Preprocessor,
    Recording,
    Segmenter,
    Start,
    StartSearch,
    Template,
    Tracker,
)
from regkit.observation import Frame
from regkit.skeleton import Pose, PoseDescription
from regkit.system.errors import NoDataError, RegkitError
from regkit.system.optional import one_thread
from regkit.system.progress import is_shown, working
from regkit.system.progress import steps as progress_steps
from regkit.tracking import Session, TrackedFrame, TrackRecorder, check_unit

POINTS = 900
"""Approximate number of points per frame without a preprocessor."""

WIDTH = 0.5
"""Standard deviation of these points, relative to the voxel size."""

Beginning = Choice[StartSearch] | Pose | PoseDescription
"""The search for the first pose, as in an experiment's ``start``; or the pose itself."""


def tracked_through(
    recording: Recording,
    template: Choice[Template],
    method: Choice[Method] | None,
    segmentation: Choices[Segmenter] | None,
    preprocessor: Choice[Preprocessor] | None,
    tracker: Choice[Tracker] | None,
    start: Beginning | None,
    place: str,
    *,
    sized_in: int = 3,
) -> Tracking:
    """Returns the track of a body; the arguments are those of ``track``.

    Args:
        recording: The recording.
        template: The body.
        method: The method.
        segmentation: The segmenters.
        preprocessor: The preprocessor.
        tracker: The tracker.
        start: The pose in the first frame.
        place: Name of the calling function in messages.
        sized_in: Number of frames that determine an unknown size.
    """
    loaded = load_template(template)
    method = Method.default() if method is None else method
    chosen = Method.parse(method, place=place, field="method")
    follows = chosen.tracker or Tracker.parse(
        Tracker.default() if tracker is None else tracker, place=place, field="tracker"
    )
    if preprocessor is not None:
        preprocessor = Preprocessor.parse(preprocessor, place=place, field="preprocessor")
    recording.prepare()
    first = _first(recording)
    check_unit(first.points, loaded, place=first.place or recording.name)
    session = Session(
        recording,
        loaded,
        preprocessor or _preprocessor_for,
        _search(start, place),
        sized_in=sized_in,
        segmentation=segmenters_of(segmentation, place=place),
    )
    with one_thread():
        begin = _begin(session)
        registrar = chosen.bind(begin.body)
        recorder = TrackRecorder(registrar, recording.fps, session.observation)
        steps = session.tracked(registrar, follows, begin.pose)
        failed = _record(recorder, _shown(steps, recording.length))
    tracking = Tracking(
        name=recording.name,
        method=name_of(method),
        fps=recording.fps,
        start=begin,
        registrar=registrar,
        recorder=recorder,
        indices=range(len(recorder)),
        track=recorder.track(),
    )
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


def _search(start: Beginning | None, place: str) -> StartSearch | Pose:
    """Returns the search for the start, or a given pose."""
    if isinstance(start, Pose):
        return start
    if isinstance(start, PoseDescription) and not isinstance(start, StartSearch):
        start = StartSearch.default("pose", **start.model_dump())
    return StartSearch.parse(start or StartSearch.default(), place=place, field="start")


def _begin(session: Session) -> Start:
    try:
        with working("searching the start"):
            return session.begin()
    except RegkitError as error:
        found = isinstance(session.start, StartSearch) and session.start.searches
        raise error if found else error.at("start") from None


def _preprocessor_for(frame: Frame) -> Preprocessor:
    """Returns a preprocessor that downsamples to about ``POINTS``, each half a voxel wide."""
    voxel = voxel_for(frame.points, POINTS)
    data = Preprocessor.default(voxel=voxel, sigma=WIDTH * (voxel or spacing(frame.points)))
    return Preprocessor.parse(data, place=frame.place or "frame", field="preprocessor")


def _shown(steps: Iterator[TrackedFrame], length: int) -> Iterator[TrackedFrame]:
    """Yields the frames, with a progress bar on a terminal if there are many."""
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
