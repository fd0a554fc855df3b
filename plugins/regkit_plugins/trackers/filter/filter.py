"""The filter tracker: each frame is weighed against what the frames before it tell."""

from __future__ import annotations

from dataclasses import dataclass, replace
from math import isnan
from typing import Annotated, Literal

import numpy as np
from pydantic import Field

from regkit.body import Body
from regkit.config.quantities import Length, Spread
from regkit.interfaces import BoundTracker, Past, Prior, Registrar, RegistrationResult, Tracker
from regkit.observation import Observation
from regkit.skeleton import Pose, Skeleton
from regkit.system.arrays import Array
from regkit_plugins.trackers.constant_velocity.recovery import BoundRecovery, Recovery
from regkit_plugins.trackers.constant_velocity.repetition import repeated
from regkit_plugins.trackers.filter.compiled import predicted_information, unforeseen_noise

USUAL = 1.0
"""Squared Mahalanobis distance per degree of freedom that is no surprise: its expectation."""

ROUNDS = 2
"""A frame is registered again so often, at most, with more noise for joints that surprise."""


class Filter(Tracker):
    """Maximum a posteriori filter on the tangent space, with a damped velocity.

    The posterior of the last frame moves on by the damped velocity and widens by the process noise;
    the method's term `motion_prior` weighs it against the data of the next frame. A joint that the
    data show follows them; one that they do not show stays, or with a damping above 0 keeps a part
    of its velocity, and grows uncertain. Without that term the prediction is only a start pose.
    """

    kind: Literal["filter"] = "filter"

    joint_deg: Spread = 5.0
    """Process noise of a joint: what its motion changes unforeseen in a frame [deg]."""
    joints_deg: dict[str, Spread] = Field(default_factory=dict)
    """Process noise of individual joints, by segment [deg]."""
    displacement: Length = 0.02
    """Process noise of a prismatic joint [m]."""
    root_m: Length = 0.1
    """Process noise of the root's position [m]."""
    root_deg: Spread = 20.0
    """Process noise of the root's orientation [deg]."""
    damping: Annotated[float, Field(ge=0.0, le=1.0)] = 0.0
    """Share of a velocity that lasts to the next frame."""
    gain: Annotated[float, Field(ge=0.0, le=1.0)] = 1.0
    """Share of an unforeseen step that counts as a change of the velocity."""
    share: Annotated[float, Field(ge=0.0, le=100.0)] = 2.0
    """Process noise of a joint that moves, besides, as a share of its motion in the last frame."""
    unforeseen: Annotated[float, Field(ge=0.0, le=100.0)] = 1.0
    """Variance of the process noise of a joint that moves farther than expected, as a share of the
    square of its step; the frame is then registered again. 0 disables it."""
    recovery: Recovery | None = Recovery()
    """Recovery of lost limbs and of a lost body; null disables it."""

    def check(self, body: Body) -> None:
        """Validates the names of joints.

        Raises:
            FieldError: If ``joints_deg`` names an unknown joint, or one that does not rotate.
        """
        self.noise(body.skeleton)

    def bind(self, registrar: Registrar) -> BoundFilter:
        """Binds the tracker and its recovery to a registrar.

        Raises:
            FieldError: If ``joints_deg`` names an unknown joint, or one that does not rotate.
        """
        recovery = None if self.recovery is None else self.recovery.bind(registrar)
        skeleton = registrar.body.skeleton
        return BoundFilter(
            self, registrar, recovery, self.noise(skeleton), np.diag(skeleton.spread).copy()
        )

    def noise(self, skeleton: Skeleton) -> Array:
        """Returns the variance of the process noise of each degree of freedom, (n,)."""
        noise = np.full(skeleton.dofs, np.radians(self.joint_deg))
        noise[skeleton.hinge_dofs][skeleton.limits.prismatic] = self.displacement
        noise[skeleton.free_dofs] = np.tile(
            np.repeat([self.root_m, np.radians(self.root_deg)], 3), len(skeleton.free_dofs) // 6
        )
        for name, degrees in self.joints_deg.items():
            noise[skeleton.rotating(name, "joints_deg")] = np.radians(degrees)
        return noise**2


@dataclass(frozen=True)
class BoundFilter(BoundTracker):
    """``Filter`` bound to a registrar.

    Attributes:
        settings: The settings.
        registrar: The registrar.
        recovery: The bound recovery, if it is enabled.
        noise: Variance of the process noise of the degrees of freedom, (n,).
        spread: Variance of poses that are spread evenly over the limits, (n,): without data the
            posterior grows to it, and not beyond.
    """

    settings: Filter
    registrar: Registrar
    recovery: BoundRecovery | None
    noise: Array
    spread: Array

    def step(self, observation: Observation, past: Past) -> RegistrationResult:
        """Registers a frame from the better of the last and the predicted pose."""
        skeleton, last = self.registrar.body.skeleton, past.last
        velocity = self._velocity(past)
        predicted = last.pose
        if velocity.any():
            predicted = skeleton.limits.projected(skeleton.retract(last.pose, velocity))
        found = self._registered(observation, past, predicted)
        kept = found
        if self.recovery is not None:
            kept = self.recovery.checked(observation, found, past)
        moved = skeleton.difference(predicted, kept.pose)
        # A limb that was found elsewhere did not move there.
        gain = self.settings.gain if kept.pose is found.pose else 0.0
        if past.before is None:
            gain = float(past.frames > 0 and gain > 0.0 and not past.missed)
        kept = past.counted(self.registrar, observation, kept)
        return replace(kept, velocity=velocity + gain * moved)

    def _registered(
        self, observation: Observation, past: Past, predicted: Pose
    ) -> RegistrationResult:
        """Registers a frame, again with more process noise where a joint moved unforeseen."""
        skeleton, last = self.registrar.body.skeleton, past.last
        candidates = [last.pose]
        if past.before is not None:
            candidates.append(repeated(skeleton, past.before.pose, last.pose))
        carried, noise = self._carried(past), self.noise * (1 + past.missed)
        prior, extra = self._prior(past, predicted, carried, noise), np.zeros(len(noise))
        found = self.registrar.register(observation, candidates, prior=prior, warm_start=last)
        for _ in range(ROUNDS if self.settings.unforeseen else 0):
            if prior.information is None:
                break
            more = unforeseen_noise(
                prior.information,
                skeleton.difference(predicted, found.pose),
                USUAL,
                self.settings.unforeseen,
                skeleton.hinge_dofs.start,
            )
            if not more.any():
                break
            extra = np.maximum(extra, more)
            prior = self._prior(past, predicted, carried, noise + extra)
            found = self.registrar.register(observation, [found.pose], prior=prior, warm_start=last)
        return found

    def _velocity(self, past: Past) -> Array:
        """Returns the step (n,) that the body is expected to take."""
        if past.last.velocity is None or past.before is None:
            return np.zeros(self.registrar.body.skeleton.dofs)
        return self.settings.damping * past.last.velocity

    def _carried(self, past: Past) -> Array | None:
        """Returns the covariance (n, n) of the last pose; None if it is unknown."""
        curvature, points = past.last.curvature, past.last.effective_points
        return None if curvature is None or isnan(points) else curvature.carried(points)

    def _prior(self, past: Past, predicted: Pose, carried: Array | None, noise: Array) -> Prior:
        """Returns the last posterior, one frame later; a pose alone in the first frame.

        Args:
            past: Results of previous frames.
            predicted: The pose that is expected.
            carried: Covariance of the last pose, (n, n); None if it is unknown.
            noise: Variance of the process noise, (n,).
        """
        last, points = past.last, past.last.effective_points
        if carried is None:
            return Prior(last.pose, points=points)
        velocity = np.zeros(len(noise)) if last.velocity is None else last.velocity
        information = predicted_information(
            carried,
            noise,
            self.settings.share * velocity,
            self.spread,
            self.registrar.body.skeleton.arrays.limits.leaders,
            self.registrar.body.skeleton.ball_dofs.start,
        )
        return Prior(predicted, information, points)
