"""Trackers: how one frame's pose leads to the next."""

from __future__ import annotations

from abc import ABC, abstractmethod
from dataclasses import dataclass

from regkit.config.plugin import Plugin
from regkit.interfaces.registrar import Registrar, RegistrationResult
from regkit.observation import Observation
from regkit.skeleton import Pose

WINDOW = 1000
"""How many frames' inlier shares are remembered: enough to say what is usual in a recording."""


@dataclass(frozen=True)
class Past:
    """What is known of the frames before; it does not grow with their number.

    Attributes:
        last: The result of the last frame; before the first frame, the start.
        before: The result of the frame before that, if there is one.
        frames: How many frames were registered.
        inlier_shares: Those of the last frames, the latest last, ``WINDOW`` at most.
    """

    last: RegistrationResult
    before: RegistrationResult | None = None
    frames: int = 0
    inlier_shares: tuple[float, ...] = ()

    @classmethod
    def start(cls, pose: Pose) -> Past:
        """What is known before the first frame."""
        return cls(RegistrationResult.given(pose))

    def followed_by(self, result: RegistrationResult) -> Past:
        """What is known one frame later."""
        return Past(
            last=result,
            before=self.last if self.frames else None,
            frames=self.frames + 1,
            inlier_shares=(*self.inlier_shares[1 - WINDOW :], result.inlier_share),
        )


class BoundTracker(ABC):
    """A tracker bound to one registrar."""

    @abstractmethod
    def step(self, observation: Observation, past: Past) -> RegistrationResult:
        """Returns the pose in the next frame.

        Args:
            observation: The frame's data.
            past: What was found before. It is an argument, not a state.
        """


class Tracker(Plugin, ABC):
    """A way from frame to frame."""

    group = "regkit.trackers"

    @abstractmethod
    def bind(self, registrar: Registrar) -> BoundTracker:
        """Do once what does not depend on the frame."""
