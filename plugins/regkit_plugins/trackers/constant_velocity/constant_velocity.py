"""The constant-velocity tracker: extrapolates the last motion of each joint."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal

from regkit.interfaces import BoundTracker, Past, Prior, Registrar, RegistrationResult, Tracker
from regkit.observation import Observation
from regkit_plugins.trackers.constant_velocity.recovery import BoundRecovery, Recovery
from regkit_plugins.trackers.constant_velocity.repetition import repeated


class ConstantVelocity(Tracker):
    """Starts each frame from the extrapolated pose, or from the last pose if it fits better."""

    kind: Literal["constant_velocity"] = "constant_velocity"

    recovery: Recovery | None = Recovery()
    """Recovery of lost limbs and of a lost body; null disables it."""

    def bind(self, registrar: Registrar) -> BoundConstantVelocity:
        """Binds the tracker and its recovery to a registrar."""
        recovery = None if self.recovery is None else self.recovery.bind(registrar)
        return BoundConstantVelocity(registrar, recovery)


@dataclass(frozen=True)
class BoundConstantVelocity(BoundTracker):
    """``ConstantVelocity`` bound to a registrar.

    Attributes:
        registrar: The registrar.
        recovery: The bound recovery, if it is enabled.
    """

    registrar: Registrar
    recovery: BoundRecovery | None

    def step(self, observation: Observation, past: Past) -> RegistrationResult:
        """Registers a frame from the better of the last and the extrapolated pose."""
        last = past.last.pose
        candidates = [last]
        if past.before is not None:
            candidates.append(repeated(self.registrar.body.skeleton, past.before.pose, last))
        # The prior is the last pose, because extrapolation would make an occluded limb drift.
        found = self.registrar.register(
            observation, candidates, prior=Prior(last), warm_start=past.last
        )
        if self.recovery is None:
            return found
        return self.recovery.checked(observation, found, past)
