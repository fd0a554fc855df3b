"""Trackers: prediction of poses from frame to frame."""

from __future__ import annotations

from abc import ABC, abstractmethod
from dataclasses import dataclass, field, replace
from math import exp, isnan, log

from regkit.body import Body
from regkit.config.plugin import Plugin
from regkit.interfaces.registrar import Registrar
from regkit.interfaces.result import RegistrationResult
from regkit.interfaces.window import Window
from regkit.observation import Observation
from regkit.skeleton import Pose

SEARCHES = 8
"""Number of stored searches, enough to make them rare while they are in vain."""


RARELY = 64
"""Number of frames between estimates of the effective number of points."""

SETTLED = 4
"""Frame in which it is estimated once more: the first pose may not be as good as the others."""


@dataclass(frozen=True)
class BodySearch:
    """A search for the whole body in an earlier frame.

    Attributes:
        age: Number of frames since, also without data; 1 for the last frame.
        points: Number of points in which the body was sought.
    """

    age: int
    points: int


@dataclass(frozen=True)
class Past:
    """The results of previous frames, with memory that does not grow with their number.

    Attributes:
        last: Result of the last frame; before the first frame, the start.
        before: Result of the frame before the last, if there is one.
        frames: Number of registered frames.
        inlier_shares: Known inlier shares of the last frames.
        missed: Number of frames without data since the last registered one.
        searches: Up to ``SEARCHES`` last searches for the whole body, the latest last.
    """

    last: RegistrationResult
    before: RegistrationResult | None = None
    frames: int = 0
    inlier_shares: Window = field(default_factory=Window)
    missed: int = 0
    searches: tuple[BodySearch, ...] = ()

    @classmethod
    def start(cls, pose: Pose) -> Past:
        """Returns the past before the first frame."""
        return cls(RegistrationResult.given(pose))

    def followed_by(self, result: RegistrationResult) -> Past:
        """Returns the past after one more frame."""
        new = (BodySearch(0, result.searched),) if result.searched else ()
        return Past(
            last=result,
            before=self.last if self.frames else None,
            frames=self.frames + 1,
            inlier_shares=self.inlier_shares.followed_by(result.inlier_share),
            searches=_older((*self.searches, *new)),
        )

    def counted(
        self, registrar: Registrar, observation: Observation, found: RegistrationResult
    ) -> RegistrationResult:
        """Returns the next result with its effective number of points, by which it is as sure.

        The number changes slowly, so it is estimated in some frames only, and smoothed.

        Args:
            registrar: The registrar.
            observation: The frame's data.
            found: Its registration.
        """
        if found.curvature is None:
            return found
        before = points = self.last.effective_points
        if isnan(before) or not self.frames % RARELY or self.frames == SETTLED:
            points = registrar.effective_points(observation, found.pose)
            if not isnan(before):
                points = before if isnan(points) else exp(0.5 * (log(before) + log(points)))
        return replace(found, effective_points=points)

    def paused(self) -> Past:
        """Returns the past without the last motion, as after a gap between two frames."""
        return replace(self, before=None)

    def interrupted(self) -> Past:
        """Returns the past after a frame without data, in which the motion is unknown."""
        return replace(self.paused(), missed=self.missed + 1, searches=_older(self.searches))


def _older(searches: tuple[BodySearch, ...]) -> tuple[BodySearch, ...]:
    """Returns the last searches, one frame later."""
    return tuple(BodySearch(one.age + 1, one.points) for one in searches[-SEARCHES:])


class BoundTracker(ABC):
    """A tracker bound to a registrar."""

    @abstractmethod
    def step(self, observation: Observation, past: Past) -> RegistrationResult:
        """Returns the registration of the next frame.

        Args:
            observation: The frame's data.
            past: Results of previous frames; the tracker itself has no state.
        """


class Tracker(Plugin, ABC):
    """A strategy for tracking from frame to frame."""

    group = "regkit.trackers"

    def check(self, body: Body) -> None:
        """Checks that the tracker's fields fit a body, before any frame is read.

        Raises:
            RegkitError: If one does not, with its field if it is a ``FieldError``.
        """

    @abstractmethod
    def bind(self, registrar: Registrar) -> BoundTracker:
        """Binds the tracker to a registrar, with all work that does not depend on frames."""
