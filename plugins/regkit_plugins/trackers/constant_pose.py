"""The tracker that starts each frame where the last one ended."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Literal

from regkit.interfaces import Follower, Registered, Registrar, Tracker
from regkit.observation import Observation


class Hold(Tracker):
    """Holds the last pose as the start of the next frame, as the paper does."""

    kind: Literal["hold"] = "hold"

    def follow(self, registrar: Registrar) -> Holding:
        """Nothing is to be prepared."""
        return Holding(registrar)


@dataclass(frozen=True)
class Holding(Follower):
    """``Hold`` for one registrar."""

    registrar: Registrar

    def step(self, observation: Observation, past: Sequence[Registered]) -> Registered:
        """Register the frame from the last pose."""
        return self.registrar.register(observation, past[-1].pose, after=past[-1])
