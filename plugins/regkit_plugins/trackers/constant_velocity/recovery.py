"""Recovery: detection of lost limbs, search for their configuration, and for a lost body."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Annotated

from pydantic import Field

from regkit.config.model import Model
from regkit.config.quantities import FrameCount
from regkit.interfaces import Past, Registrar, RegistrationResult
from regkit.observation import Observation
from regkit.search.limb_recovery import GAIN, SAMPLES, STARTS, LimbRecovery
from regkit_plugins.trackers.constant_velocity.reinitialization import (
    BoundReinitialization,
    Reinitialization,
)

BEST_SHARE = 0.25
"""Quantile of the outlier fraction over past frames that counts as usual."""


class Recovery(Model):
    """Recovers lost limbs by trying other configurations of each limb.

    It searches when a frame has more outliers than usual in the recording, or landmarks that
    contradict the pose. Of many configurations within the joint limits, it registers the few that
    best match the landmarks, or the points that the rest of the body does not explain, and keeps
    one that fits the frame better. Where limbs do not explain the outliers, the whole body is
    sought anew.
    """

    samples: Annotated[int, Field(ge=2, le=100_000)] = SAMPLES
    """Number of sampled configurations per limb."""
    starts: Annotated[int, Field(ge=1, le=1000)] = STARTS
    """Number of configurations per limb that are registered."""
    gain: Annotated[float, Field(ge=0.0, lt=1.0)] = GAIN
    """Minimum increase of the mean inlier probability for accepting a new configuration."""
    alarm: Annotated[float, Field(ge=1.0, le=1e6)] = 1.3
    """Search if the fraction of outliers exceeds the usual one by this factor, plus ``gain``."""
    every: FrameCount = 20
    """Number of frames between unconditional searches, which begin in the first frame."""
    reinitialization: Reinitialization | None = Reinitialization()
    """Search for the whole body when limbs do not explain the outliers; null disables it."""

    def bind(self, registrar: Registrar) -> BoundRecovery:
        """Samples the configurations, which are the same for all frames."""
        limbs = LimbRecovery.of(registrar, self.samples, self.starts, self.gain)
        body = None if self.reinitialization is None else self.reinitialization.bind(limbs)
        return BoundRecovery(self, limbs, body)


@dataclass(frozen=True)
class BoundRecovery:
    """``Recovery`` bound to a registrar.

    Attributes:
        recovery: The recovery.
        limbs: Search for the configurations of the limbs.
        body: Search for the whole body, if it is enabled.
    """

    recovery: Recovery
    limbs: LimbRecovery
    body: BoundReinitialization | None

    def checked(
        self,
        observation: Observation,
        found: RegistrationResult,
        past: Past,
    ) -> RegistrationResult:
        """Returns the registration, or a better one with another configuration of limbs or body."""
        if not self._alarmed(found, past):
            return self.limbs.corrected(observation, found)
        better = self.limbs.recovered(observation, found)
        if self.body is None:
            return better
        return self.body.checked(observation, found, better, past, self._usual(past))

    def _alarmed(self, found: RegistrationResult, past: Past) -> bool:
        """Returns whether there are more outliers than usual, or a search is due."""
        if past.frames % self.recovery.every == 0 or past.missed:
            return True
        # Excess outliers below ``gain`` cannot lead to an accepted configuration.
        return 1.0 - found.inlier_share > self._usual(past) + self.recovery.gain

    def _usual(self, past: Past) -> float:
        """Returns the fraction of outliers that raises no alarm."""
        # The least outliers are in the frames with the largest inlier shares.
        share = past.inlier_shares.quantile(1.0 - BEST_SHARE) if past.inlier_shares else 1.0
        return self.recovery.alarm * (1.0 - share)
