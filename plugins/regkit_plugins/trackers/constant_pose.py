"""The constant-pose tracker: starts each frame from the last pose."""

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
        """Binds the tracker to a registrar."""
        return BoundConstantPose(registrar)


@dataclass(frozen=True)
class BoundConstantPose(BoundTracker):
    """``ConstantPose`` bound to a registrar.

    Attributes:
        registrar: The registrar.
    """

    registrar: Registrar

    def step(self, observation: Observation, past: Past) -> RegistrationResult:
        """Registers a frame from the last pose."""
        return self.registrar.register(observation, [past.last.pose], warm_start=past.last)
