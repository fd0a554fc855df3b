"""The tracker that starts each frame where the last one ended."""

from __future__ import annotations

from dataclasses import dataclass
from typing import ClassVar, Literal

from regkit.interfaces import BoundTracker, Past, Registrar, RegistrationResult, Tracker
from regkit.observation import Observation


class ConstantPose(Tracker):
    """Starts each frame from the pose of the last one, as the paper does."""

    formerly: ClassVar[tuple[str, ...]] = ("hold",)
    kind: Literal["constant_pose"] = "constant_pose"

    def bind(self, registrar: Registrar) -> BoundConstantPose:
        """Nothing is to be prepared."""
        return BoundConstantPose(registrar)


@dataclass(frozen=True)
class BoundConstantPose(BoundTracker):
    """``ConstantPose`` for one registrar."""

    registrar: Registrar

    def step(self, observation: Observation, past: Past) -> RegistrationResult:
        """Register the frame from the last pose."""
        return self.registrar.register(observation, [past.last.pose], warm_start=past.last)
