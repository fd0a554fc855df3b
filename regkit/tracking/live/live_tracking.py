"""Tracking of a stream: the body is sought in its first frames, and followed as frames come."""

from __future__ import annotations

import time
import warnings
from collections import deque
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from math import ceil

from regkit.body import Body
from regkit.body.verdict import Verdict
from regkit.interfaces import (
    Recording,
    Registrar,
    RegistrationResult,
    Start,
    Stream,
    TimedFrame,
    Tracker,
)
from regkit.system.brief import Brief
from regkit.system.errors import DataError, NoBodyError, NoDataError, RegkitError, SourceLostError
from regkit.system.notes import RegkitWarning
from regkit.system.progress import working
from regkit.tracking.live.latency import Quantiles
from regkit.tracking.live.opening import Opening, openings
from regkit.tracking.live.paced import PacedStream
from regkit.tracking.live.reader import Arrived, FrameReader
from regkit.tracking.live.watch import StreamWatch
from regkit.tracking.loop import Follower, TrackedFrame
from regkit.tracking.recorder import RecordedFrame, TrackRecorder
from regkit.tracking.rows import Rows
from regkit.tracking.session import Session

OPENING = 2.0
"""Duration of a camera's opening [s], for which a person waits."""

RECORDED_OPENING = 10.0
"""Duration of a recording's opening [s], which shows more of the body and of what moves."""

PATIENCE = 0.2
"""Time between two looks at whether to stop while no frame comes [s]."""

STALL = 2.0
"""A stream without a frame for this time has stalled [s]."""


@dataclass(frozen=True)
class LiveFrame(Brief):
    """A frame of a stream, tracked.

    Attributes:
        number: Its number in the stream, from 0; dropped frames count too.
        time: Its time on the stream's clock [s].
        tracked: The result.
        recorded: What is recorded of it.
        latency: Time from its arrival to its pose [s].
    """

    number: int
    time: float
    tracked: TrackedFrame
    recorded: RecordedFrame
    latency: float


@dataclass(frozen=True)
class LiveSetup:
    """How a stream is tracked.

    Attributes:
        session: Returns the session of a recording with the stream's first frames.
        bind: Binds the method to the body that was found.
        tracker: Tracker from frame to frame.
        rows: Returns where the values of a track are kept; in memory by default.
        opening: Duration of the opening [s]; for None that of a camera or of a recording.
        every_frame: Whether every frame of a camera is tracked, however late.
        realtime: Whether a recording is played at its own pace after its opening was seen.
        tap: Called with every frame of the track when it is read, in another thread.
        check: Called between two frames, and while none comes; what it raises ends the tracking.
    """

    session: Callable[[Recording], Session]
    bind: Callable[[Body], Registrar]
    tracker: Tracker
    rows: Callable[[Start], Rows] | None = None
    opening: float | None = None
    every_frame: bool = False
    realtime: bool = False
    tap: Callable[[TimedFrame], None] | None = None
    check: Callable[[], None] = lambda: None


class LiveTracking:
    """A stream that is being tracked; its memory does not grow with the number of frames.

    Of a camera the newest frame is tracked. Of a recording every frame is, from the one in which
    the body comes into sight.

    Args:
        source: Opens the stream; a recording is opened again after its opening was seen.
        setup: How it is tracked.

    Raises:
        RegkitError: If the source cannot be opened.
    """

    def __init__(self, source: Callable[[], Stream], setup: LiveSetup) -> None:
        self._source = source
        self._setup = setup
        self.stream = source()
        # Of a recording, the opening is read again.
        self._reader = self._reading(self.stream, tapped=self.stream.live)
        self.watch = StreamWatch(self.stream.name, self.stream.fps)
        self.latencies = Quantiles()
        # Those that an opening may begin with; it lasts a little longer than it should.
        self._opening = setup.opening or (OPENING if self.stream.live else RECORDED_OPENING)
        span = 2.0 * self._opening * self.stream.fps
        self._dropped_before = 0
        self._early: deque[Arrived] = deque(maxlen=ceil(span) + 1)
        self._damage: RegkitError | None = None
        self._found: tuple[Session, Start, Opening] | None = None
        self._recorder: TrackRecorder | None = None

    @property
    def dropped(self) -> int:
        """Number of frames since the start that were not tracked because newer ones had arrived."""
        return self._all_dropped - self._dropped_before

    @property
    def _all_dropped(self) -> int:
        return self._reader.dropped + self._reader.stream.dropped

    @property
    def is_live(self) -> bool:
        """Whether frames come at their own pace."""
        return self._reader.stream.live

    @property
    def is_begun(self) -> bool:
        """Whether a body has come into sight."""
        return self._found is not None

    @property
    def start(self) -> Start:
        """The pose and size with which the tracking began, sought when they are first needed.

        Raises:
            RegkitError: If the stream ends before a body comes into sight, or is damaged.
        """
        return self._begun()[1]

    @property
    def recorder(self) -> TrackRecorder:
        """What was tracked so far.

        Raises:
            RegkitError: As ``start``.
        """
        if self._recorder is None:
            start = self.start
            rows = None if self._setup.rows is None else self._setup.rows(start)
            registrar = self._setup.bind(start.body)
            self._recorder = TrackRecorder(registrar, self.stream.fps, rows=rows)
        return self._recorder

    def close(self) -> None:
        """Ends the reading of the stream."""
        self._reader.close()

    def frames(self) -> Iterator[LiveFrame]:
        """Yields the frames as they are tracked.

        Raises:
            SourceLostError: If no further frame comes although the stream has not ended, or most of
                them are damaged.
            RegkitError: If no body comes into sight, or a frame cannot be registered.
        """
        session, start, opening = self._begun()
        recorder, registrar = self.recorder, self.recorder.registrar
        follower = session.follower(registrar, self._setup.tracker, start.pose)
        before = RegistrationResult.given(start.pose).without_data("not in sight yet")
        for arrived in self._frames_from(opening, session):
            if not self.stream.live and arrived.number < opening.first:
                if arrived.frame is None:
                    self.watch.damaged(arrived, str(arrived.error or "it is damaged"))
                tracked: TrackedFrame | None = TrackedFrame(None, before, 0.0, 0.0)
            else:
                tracked = self._followed(follower, arrived)
            if tracked is None:
                continue
            moment = arrived.number / self.stream.fps
            moment = moment if arrived.frame is None else arrived.frame.time
            recorded = recorder.add(tracked, arrived.number, moment)
            latency = time.perf_counter() - arrived.at
            self.latencies.add(latency)
            yield LiveFrame(arrived.number, moment, tracked, recorded, latency)

    def _followed(self, follower: Follower, arrived: Arrived) -> TrackedFrame | None:
        """Returns a frame, tracked; None if it adds nothing to the last one."""
        frame = arrived.frame
        try:
            if frame is None:
                raise arrived.error or DataError("it is damaged")
            if self.watch.is_repeated(arrived.number, frame):
                return None
            gap = self.watch.gap(arrived.number, frame)
            if gap is not None:
                follower.pause(gap)
            return follower.follow(frame.frame)
        except DataError as error:
            self.watch.damaged(arrived, str(error))
            if self.watch.is_lost:
                raise SourceLostError(
                    f"too many frames in a row cannot be tracked, the last one because: {error}",
                    place=self.stream.name,
                ) from None
            return follower.skip(error.message)

    def _begun(self) -> tuple[Session, Start, Opening]:
        if self._found is None:
            self._found = self._sought()
        return self._found

    def _sought(self) -> tuple[Session, Start, Opening]:
        """Returns the first opening in which a body is found, with its session and start.

        Raises:
            RegkitError: If the stream ends before. The last reason is told.
        """
        first: tuple[Session, Start, Opening] | None = None
        reason: NoDataError = NoDataError("it has no frame with a measurement")
        stream, seconds = self.stream, self._opening
        for opening in openings(self._seen(), stream.name, stream.fps, seconds):
            session = self._setup.session(opening.recording)
            # What is told of an attempt matters only if the tracking begins with it.
            with warnings.catch_warnings(record=True) as told:
                warnings.simplefilter("always")
                try:
                    with working("looking for the body"):
                        start = session.begin()
                except NoDataError as error:
                    reason = error
                    continue
            for one in told:
                if not issubclass(one.category, RegkitWarning) or start.verdict is not Verdict.LOST:
                    warnings.warn_explicit(one.message, one.category, one.filename, one.lineno)
            if start.verdict is not Verdict.LOST:
                return session, start, opening
            first = first or (session, start, opening)
        if first is not None and not stream.live:
            # A recording without a surely found body is tracked from its first frames, and said to
            # be lost.
            return first
        why = reason.message
        if self._damage is not None:
            why += f"; damaged frames are passed over, the last one because: {self._damage}"
        raise NoBodyError(f"no body comes into sight: {why}", place=stream.name)

    def _seen(self) -> Iterator[Arrived]:
        """Yields the frames of the openings."""
        for arrived in self._arrivals():
            if self.stream.live and self._setup.every_frame:
                self._early.append(arrived)
            self._damage = arrived.error or self._damage
            yield arrived

    def _frames_from(self, opening: Opening, session: Session) -> Iterator[Arrived]:
        """Yields the frames to track."""
        every_frame = self._setup.every_frame
        if self.stream.live and every_frame:
            yield from (one for one in self._early if one.number >= opening.first)
            self._early.clear()
        else:
            self._warm(session, opening)
            if self.stream.live and (found := opening.arrived[0]).frame is not None:
                # Since then the body has moved.
                self.watch.gap(found.number, found.frame)
        self._dropped_before = self._all_dropped
        if not self.stream.live:
            self._reader.close()
            stream = self._source()
            stream = PacedStream(stream) if self._setup.realtime else stream
            self._reader = self._reading(stream, tapped=True)
        yield from self._arrivals()

    def _reading(self, stream: Stream, *, tapped: bool) -> FrameReader:
        setup = self._setup
        return FrameReader(stream, every_frame=setup.every_frame, tap=setup.tap if tapped else None)

    def _warm(self, session: Session, opening: Opening) -> None:
        """Loads everything that a step needs, so that no camera's frame waits for it."""
        registrar, pose = self.recorder.registrar, self.start.pose
        follower = session.follower(registrar, self._setup.tracker, pose)
        follower.follow(opening.recording.given[0])

    def _arrivals(self) -> Iterator[Arrived]:
        """Yields the frames of the reader until its end."""
        waited = 0.0
        while not self._reader.ended:
            self._setup.check()
            arrived = self._reader.next(PATIENCE)
            if arrived is not None:
                waited = 0.0
                yield arrived
            elif not self._reader.ended:
                waited += PATIENCE
                if STALL <= waited < STALL + PATIENCE:
                    self.watch.stalled(waited)
