"""Trackers: how one frame's pose leads to the next."""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Sequence

from regkit.config.plugin import Plugin
from regkit.interfaces.registrar import Registered, Registrar
from regkit.observation import Observation


class Follower(ABC):
    """A tracker made ready for one registrar."""

    @abstractmethod
    def step(self, observation: Observation, past: Sequence[Registered]) -> Registered:
        """The pose in the next frame.

        Args:
            observation: The frame's data.
            past: What was found before; it begins with the start, and is an argument, not a state.
        """


class Tracker(Plugin, ABC):
    """A way from frame to frame."""

    group = "regkit.trackers"

    @abstractmethod
    def follow(self, registrar: Registrar) -> Follower:
        """Do once what does not depend on the frame."""
