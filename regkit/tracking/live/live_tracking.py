"""Tracking of a stream: the body is sought in its first frames, and followed as frames come."""

from __future__ import annotations

import time
from collections import deque
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from functools import partial
from itertools import islice
from math import ceil

from regkit.interfaces import RegistrationResult, Start, Stream
from regkit.observation import Frame
from regkit.system.brief import Brief
from regkit.system.errors import DataError, NoBodyError, RegkitError, SourceLostError
from regkit.tracking.live.beginning import Beginning, beginning_in
from regkit.tracking.live.latency import Quantiles
from regkit.tracking.live.opening import openings
from regkit.tracking.live.paced import PacedStream
from regkit.tracking.live.reader import Arrived, FrameReader
from regkit.tracking.live.setup import LiveSetup
from regkit.tracking.live.watch import StreamWatch
from regkit.tracking.loop import Follower, TrackedFrame
from regkit.tracking.recorder import RecordedFrame, TrackRecorder

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
        span = 2.0 * setup.opening_of(live=self.stream.live) * self.stream.fps
        self._dropped_before = 0
        self._early: deque[Arrived] = deque(maxlen=ceil(span) + 1)
        self._damage: RegkitError | None = None
        self._clock = 0, 0.0
        self._beginning: Beginning | None = None
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
        return self._beginning is not None

    @property
    def start(self) -> Start:
        """The pose and size with which the tracking began, sought when they are first needed.

        Raises:
            RegkitError: If the stream ends before a body comes into sight, or is damaged.
        """
        return self._begun().start

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
        begun, recorder = self._begun(), self.recorder
        start, opening = begun.start, begun.opening
        follower = self._follower(begun)
        if (found := opening.arrived[0]).frame is not None:
            # Damaged frames before the opening precede its time.
            self._clock = found.number, found.frame.time
        before = RegistrationResult.given(start.pose).without_data("not in sight yet")
        for arrived in self._frames_from(begun):
            if not self.stream.live and arrived.number < opening.first:
                if arrived.frame is None:
                    self.watch.damaged(arrived, str(arrived.error or "it is damaged"))
                tracked: TrackedFrame | None = TrackedFrame(None, before, 0.0, 0.0)
            else:
                tracked = self._followed(follower, arrived)
            if tracked is None:
                continue
            moment = self._time_of(arrived)
            recorded = recorder.add(tracked, arrived.number, moment)
            latency = time.perf_counter() - arrived.at
            self.latencies.add(latency)
            yield LiveFrame(arrived.number, moment, tracked, recorded, latency)

    def _time_of(self, arrived: Arrived) -> float:
        """Returns the time of a frame [s]; a damaged one follows the last whole one at the rate."""
        number, at = self._clock
        if arrived.frame is None:
            return at + (arrived.number - number) / self.stream.fps
        self._clock = arrived.number, arrived.frame.time
        return arrived.frame.time

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
            found = follower.follow(frame.frame)
        except DataError as error:
            self.watch.damaged(arrived, str(error))
            if self.watch.is_lost:
                raise SourceLostError(
                    f"too many frames in a row cannot be tracked, the last one because: {error}",
                    place=self.stream.name,
                ) from None
            return follower.skip(error.message)
        self.watch.tracked()
        return found

    def _begun(self) -> Beginning:
        if self._beginning is None:
            stream, seconds = self.stream, self._setup.opening_of(live=self.stream.live)
            opened = openings(self._seen(), stream.name, stream.fps, seconds)
            try:
                self._beginning = beginning_in(opened, self._setup.session, live=stream.live)
            except NoBodyError as error:
                why = error.message
                if self._damage is not None:
                    why += f"; damaged frames are passed over, the last one because: {self._damage}"
                raise NoBodyError(why, place=stream.name) from None
        return self._beginning

    def _seen(self) -> Iterator[Arrived]:
        """Yields the frames of the openings."""
        for arrived in self._arrivals():
            if self.stream.live and self._setup.every_frame:
                self._early.append(arrived)
            self._damage = arrived.error or self._damage
            yield arrived

    def _follower(self, begun: Beginning) -> Follower:
        registrar, tracker = self.recorder.registrar, self._setup.tracker
        early = tuple if self.stream.live else partial(self._frames_since, begun.opening.first)
        return begun.session.follower(registrar, tracker, begun.start.pose, early)

    def _frames_since(self, first: int) -> Iterator[Frame]:
        """Yields the frames of a recording from a number on, read in advance."""
        with self._source() as stream:
            for timed in islice(stream, first, None):
                yield timed.frame

    def _frames_from(self, begun: Beginning) -> Iterator[Arrived]:
        """Yields the frames to track."""
        opening = begun.opening
        every_frame = self._setup.every_frame
        if self.stream.live and every_frame:
            yield from (one for one in self._early if one.number >= opening.first)
            self._early.clear()
        else:
            # Everything that a step needs is loaded, so that no camera's frame waits for it.
            begun.session.follower(
                self.recorder.registrar, self._setup.tracker, begun.start.pose
            ).follow(opening.recording.given[0])
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
