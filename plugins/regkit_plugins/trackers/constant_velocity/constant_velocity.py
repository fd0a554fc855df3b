"""The tracker that expects each joint to go on as it moved last."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal

from regkit.interfaces import BoundTracker, Past, Registrar, RegistrationResult, Tracker
from regkit.observation import Observation
from regkit.skeleton import Pose
from regkit_plugins.trackers.constant_velocity.recovery import BoundRecovery, Recovery


class ConstantVelocity(Tracker):
    """Starts each frame where the last motion leads, if that pose fits the frame better."""

    kind: Literal["constant_velocity"] = "constant_velocity"

    recovery: Recovery | None = Recovery()
    """How lost limbs are found again; null for not at all."""

    def bind(self, registrar: Registrar) -> BoundConstantVelocity:
        """Prepare the recovery."""
        recovery = None if self.recovery is None else self.recovery.bind(registrar)
        return BoundConstantVelocity(registrar, recovery)


@dataclass(frozen=True)
class BoundConstantVelocity(BoundTracker):
    """``ConstantVelocity`` for one registrar."""

    registrar: Registrar
    recovery: BoundRecovery | None

    def step(self, observation: Observation, past: Past) -> RegistrationResult:
        """Register the frame from the better of the last pose and the predicted one."""
        last = past.last.pose
        candidates = [last]
        if past.before is not None:
            candidates.append(self._predicted(past.before.pose, last))
        # The prior is the last pose: a hidden limb would run away if it went on as it moved last.
        found = self.registrar.register(observation, candidates, prior=last, warm_start=past.last)
        if self.recovery is None:
            return found
        return self.recovery.checked(observation, found, past)

    def _predicted(self, before: Pose, last: Pose) -> Pose:
        """Where the last step leads if it is taken again, within the limits."""
        bones = self.registrar.body.skeleton
        return bones.limits.projected(bones.retract(last, bones.difference(before, last)))
