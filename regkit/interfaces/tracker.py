"""Trackers: how one frame's pose leads to the next."""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Sequence

from regkit.interfaces.method import Registered, Registrar
from regkit.observation import Observation
from regkit.plugin import Plugin
from regkit.skeleton import Pose


class Tracker(Plugin, ABC):
    """Registers a frame with what the past frames tell; the past is an argument, not a state."""

    group = "regkit.trackers"

    @abstractmethod
    def step(
        self, registrar: Registrar, observation: Observation, past: Sequence[Pose]
    ) -> Registered:
        """The pose in the next frame; ``past`` ends with the last pose, at first the start."""
