"""A tracking session: recording, template, segmentation, preprocessor and start."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator
from contextlib import suppress
from dataclasses import dataclass, field
from functools import cached_property
from itertools import islice

import numpy as np

from regkit.body.verdict import Verdict
from regkit.interfaces import (
    Chain,
    Expected,
    Preprocessor,
    Recording,
    Registrar,
    Segmenter,
    Start,
    StartSearch,
    Template,
    Tracker,
)
from regkit.observation import Frame, Observation
from regkit.skeleton import Pose
from regkit.system.errors import ConfigError, NoBodyError, NoDataError, RegkitError
from regkit.system.notes import note
from regkit.tracking.clocks import LONGEST_TRIAL, ClockWatch
from regkit.tracking.extent import check_extent, check_unit, tell_bound
from regkit.tracking.landmarks import tell_unknown
from regkit.tracking.loop import Follower, TrackedFrame, tracked
from regkit.tracking.segmented import segmented


def default_start() -> StartSearch:
    """Returns the search that is used when none is named."""
    return StartSearch.parse(StartSearch.default(), place="regkit", field="start")


@dataclass(frozen=True)
class Session:
    """A recording to track, the same for every method.

    Attributes:
        recording: Source of the frames.
        template: Template of the body.
        preprocessor: Preprocessor of the frames, or a function that chooses one for the first frame
            with data, after segmentation.
        start: The search for pose and size in the first frame, or the pose, which requires the
            template's size.
        sized_in: Number of frames, spread over the recording, that determine an unknown size.
        segmentation: Segmenters that take the body out of the scene, applied in order before the
            preprocessor.
    """

    recording: Recording
    template: Template
    preprocessor: Preprocessor | Callable[[Frame], Preprocessor]
    start: StartSearch | Pose = field(default_factory=default_start)
    sized_in: int = 3
    segmentation: tuple[Segmenter, ...] = ()

    @cached_property
    def segmenter(self) -> Chain:
        """The segmenters, bound to the recording when they are first needed.

        Raises:
            RegkitError: If the data have another unit than the template, or suit no segmenter.
        """
        for frame in self.recording.frames() if self.segmentation else ():
            if len(frame.points):
                check_unit(frame.points, self.template, place=self.recording.name)
                break
        return Chain.of(self.segmentation, self.recording, self.template)

    @cached_property
    def observes(self) -> Preprocessor:
        """The preprocessor; one to choose is chosen when it is first needed."""
        if isinstance(self.preprocessor, Preprocessor):
            return self.preprocessor
        for frame in self.recording.frames():
            left = self.segmenter.segmented(frame, None)
            if len(left.points):
                return self.preprocessor(left)
        raise NoBodyError(
            "no frame has a measurement that may be the body's (segmentation; regkit preview shows "
            "what is removed)",
            place=self.recording.name,
        )

    def begin(self) -> Start:
        """Returns the body at its size, and its pose in the first frame.

        Raises:
            RegkitError: If the given start does not fit the body, the first frame cannot be read,
                or no start can be found.
        """
        index, first = self._first()
        check_extent(first.points, self.template, place=self.recording.name)
        tell_unknown(first.landmarks, self.template, place=self.recording.name)
        if isinstance(self.start, Pose):
            return _posed(self.template, self.start)
        start = self.start.find(self.template, [first, *self._later(index)])
        tell_bound(start.body.size, self.template, place=self.recording.name)
        if start.verdict is not Verdict.FOUND:
            note(f"{start.summary}: {start.reason}", place=self.recording.name)
        return start

    def follower(
        self,
        registrar: Registrar,
        tracker: Tracker,
        pose: Pose,
        early: Callable[[], Iterable[Frame]] = tuple,
    ) -> Follower:
        """Returns what tracks the body from a pose, frame by frame.

        Of several cameras, the first frames are tracked on trial if they are known already, so that
        one with a wrong clock is left out from the first frame on.

        Args:
            registrar: Method bound to the body.
            tracker: Tracker that predicts the next pose.
            pose: Pose of the body in the first frame.
            early: Returns the first frames, if they can be read in advance.
        """
        recording = self.recording
        parts = (self.segmenter, self.observes, registrar, tracker, pose)
        if not recording.cameras():
            return Follower(*parts)
        clocks = ClockWatch(registrar, recording.fps, recording.name)
        trial = Follower(*parts, clocks)
        for frame in islice(early(), LONGEST_TRIAL):
            # An error is reported when the frame is tracked.
            with suppress(RegkitError):
                trial.follow(frame)
            if clocks.is_decided:
                break
        clocks.restart()
        return Follower(*parts, clocks)

    def tracked(self, registrar: Registrar, tracker: Tracker, pose: Pose) -> Iterator[TrackedFrame]:
        """Yields the recording's frames, tracked one by one from a pose.

        Args:
            registrar: Method bound to the body.
            tracker: Tracker that predicts the next pose.
            pose: Pose of the body in the first frame.

        Raises:
            RegkitError: If a frame cannot be read or registered; the error names it.
        """
        follower = self.follower(registrar, tracker, pose, self.recording.frames)
        return tracked(self.recording, follower)

    def observation(self, index: int, expected: Expected | None = None) -> Observation:
        """Returns the data of a frame.

        Args:
            index: Number of the frame.
            expected: What is known of the body in the frame before.

        Raises:
            RegkitError: If the frame cannot be read.
        """
        ((_, frame),) = self.recording.some([index])
        return self._preprocessed(index, frame, expected)

    def _later(self, first: int) -> Iterator[Observation]:
        """Yields usable frames after the first one, if the size is unknown."""
        count = 1 if self.template.given_size() is not None else self.sized_in
        later = [index for index in _spread(self.recording.length, count) if index > first]
        for index, frame in self.recording.some(later):
            # An error in a later frame is reported when that frame is tracked.
            with suppress(RegkitError):
                yield self._preprocessed(index, frame)

    def _first(self) -> tuple[int, Observation]:
        """Returns the first frame with data, and its index.

        Raises:
            NoDataError: If no frame has data; the error is that of the first frame.
            RegkitError: If a frame before it is damaged.
        """
        missing = NoDataError("the recording has no frame", place=self.recording.name)
        for index, frame in enumerate(self.recording.frames()):
            try:
                return index, self._preprocessed(index, frame)
            except NoDataError as error:
                missing = missing if index else error
        raise missing

    def _preprocessed(
        self, index: int, frame: Frame, expected: Expected | None = None
    ) -> Observation:
        try:
            return self.observes.observation(segmented(self.segmenter, frame, expected))
        except RegkitError as error:
            raise error.at(frame.place or f"{self.recording.name}: frame {index}") from None


def _spread(length: int, count: int) -> Iterable[int]:
    """Returns ``count`` frame indices spread evenly from the first to the last."""
    return sorted({(length - 1) * part // max(count - 1, 1) for part in range(count)})


def _posed(template: Template, pose: Pose) -> Start:
    """Returns the start for a given pose.

    Raises:
        ConfigError: If the size is unknown, or the pose belongs to another skeleton.
    """
    size = template.given_size()
    if size is None:
        raise ConfigError("a given start needs the template's size")
    body = template.body(size)
    rest = body.skeleton.rest()
    for name in ("root", "balls", "hinges"):
        given, wanted = np.shape(getattr(pose, name)), np.shape(getattr(rest, name))
        if given != wanted:
            raise ConfigError(
                f"a pose of another body: its {name} are {given}, those of '{body.name}' {wanted}"
            )
    return Start(body, pose)
