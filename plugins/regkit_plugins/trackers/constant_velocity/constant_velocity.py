"""The tracker that expects each joint to go on as it moved last."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Literal

from regkit.interfaces import Follower, Registered, Registrar, Tracker
from regkit.observation import Observation
from regkit.skeleton import Pose
from regkit_plugins.trackers.constant_velocity.recovery import Recovery, Rescuer


class ConstantVelocity(Tracker):
    """Starts each frame where the last motion leads, if that explains the frame better."""

    kind: Literal["constant_velocity"] = "constant_velocity"

    recovery: Recovery | None = Recovery()
    """How lost limbs are found again; null for not at all."""

    def follow(self, registrar: Registrar) -> Coasting:
        """Prepare the recovery."""
        rescuer = None if self.recovery is None else self.recovery.prepare(registrar)
        return Coasting(registrar, rescuer)


@dataclass(frozen=True)
class Coasting(Follower):
    """``ConstantVelocity`` for one registrar."""

    registrar: Registrar
    rescuer: Rescuer | None

    def step(self, observation: Observation, past: Sequence[Registered]) -> Registered:
        """Register the frame from the better of the last pose and the predicted one."""
        # What is hidden is expected to stay; it would run away if it went on as it moved last.
        last = past[-1].pose
        moved = [self._predicted(past[-2].pose, last)] if len(past) > 2 else []
        found = self.registrar.register(observation, last, *moved, after=past[-1])
        if self.rescuer is None:
            return found
        return self.rescuer.checked(observation, found, past)

    def _predicted(self, before: Pose, last: Pose) -> Pose:
        """Where the last step leads if it is taken again, within the limits."""
        bones = self.registrar.body.skeleton
        return bones.limits.projected(bones.retract(last, bones.difference(before, last)))
