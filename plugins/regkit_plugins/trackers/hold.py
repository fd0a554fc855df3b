"""The tracker that starts each frame where the last one ended."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Literal

from regkit.interfaces import Registered, Registrar, Tracker
from regkit.observation import Observation
from regkit.skeleton import Pose


class Hold(Tracker):
    """Holds the last pose as the start of the next frame, as the paper does."""

    kind: Literal["hold"] = "hold"

    def step(
        self, registrar: Registrar, observation: Observation, past: Sequence[Pose]
    ) -> Registered:
        """Register the frame from the last pose."""
        return registrar.register(observation, past[-1])
