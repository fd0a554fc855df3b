"""Smoothing: each pose of a track by what the frames before and after it tell."""

from __future__ import annotations

from dataclasses import replace
from itertools import pairwise
from typing import Annotated

import numpy as np
from pydantic import Field

from regkit.body import Body
from regkit.config.model import Model
from regkit.config.quantities import Length, Spread
from regkit.registration.compiled_posterior import expanded, inverted
from regkit.skeleton import Pose, Skeleton
from regkit.system.arrays import Array
from regkit.system.errors import ConfigError
from regkit.tracking.kalman import Motion, smoothed_states
from regkit.tracking.track import Track

BEGINS = 4.0
"""Standard deviation of the velocity in the first frame, in those of its change in a frame."""


class Smoothing(Model):
    """How the body moves, for the smoother.

    The velocity of each degree of freedom changes from frame to frame by a normal deviate, and
    fades where the data tell nothing of it.
    """

    joint_deg: Spread = 5.0
    """Change of a joint's velocity in a frame [deg]."""
    root_m: Length = 0.01
    """Change of the root's velocity in a frame [m]."""
    root_deg: Spread = 2.0
    """Change of the root's angular velocity in a frame [deg]."""
    damping: Annotated[float, Field(ge=0.0, le=1.0)] = 0.9
    """Share of a velocity that lasts to the next frame."""

    share: Annotated[float, Field(gt=0.0, le=1.0)] = 0.5
    """Share of a frame's information that is new: what the model lacks, it lacks in the next frame
    too."""

    def changes(self, skeleton: Skeleton) -> Array:
        """Returns the variance of the velocity's change in a frame, (n,)."""
        change = np.full(skeleton.dofs, np.radians(self.joint_deg))
        change[skeleton.free_dofs] = np.tile(
            np.repeat([self.root_m, np.radians(self.root_deg)], 3), len(skeleton.free_dofs) // 6
        )
        return change**2


def smoothed(track: Track, body: Body, settings: Smoothing | None = None) -> Track:
    """Returns a track whose poses are the most likely ones, given all of its frames.

    This is the Rauch-Tung-Striebel smoother on the tangent space at the tracked poses: a Kalman
    filter runs forward with what each frame's data tell, and a second pass runs backward. Hidden
    limbs and frames without data are interpolated; the verdicts of the frames stay.

    Args:
        track: The track, with its information.
        body: The tracked body.
        settings: How the body moves.

    Raises:
        ConfigError: If the track does not know how sure its poses are.
    """
    if track.information is None or track.pulls is None:
        raise ConfigError(
            "the track does not know how sure its poses are, so that it cannot be smoothed; take a "
            "method whose kernel knows its residuals, such as the preset 'filtered'",
            place="smooth",
        )
    settings = Smoothing() if settings is None else settings
    skeleton = body.skeleton
    own, arrays = skeleton.independent_dofs, skeleton.arrays
    poses = [track.pose(index) for index in range(len(track))]
    steps = [skeleton.difference(before, after)[own] for before, after in pairwise(poses)]
    change, spread = settings.changes(skeleton)[own], skeleton.spread[np.ix_(own, own)]
    motion = Motion(np.diag(change), settings.damping, spread, np.diag(BEGINS**2 * change))
    # A frame without data tells nothing.
    information = settings.share * np.nan_to_num(track.information)
    pulls = settings.share * np.nan_to_num(track.pulls)
    offsets, covariances = smoothed_states(
        np.array(steps).reshape(-1, len(own)), information, pulls, motion
    )
    limits = arrays.limits
    wide = np.zeros((len(track), skeleton.dofs))
    wide[:, own] = offsets
    moved = [_moved(skeleton, pose, step) for pose, step in zip(poses, wide, strict=True)]
    within = np.linalg.inv(spread)
    hinges = skeleton.hinge_dofs.start
    return replace(
        track,
        root=np.array([pose.root for pose in moved]),
        balls=np.array([pose.balls for pose in moved]),
        hinges=np.array([pose.hinges for pose in moved]),
        markers=np.array([body.markers.place(body.place(pose).transforms) for pose in moved]),
        # No joint is less certain than its limits allow.
        covariances=np.array([
            expanded(limits, hinges, inverted(inverted(one) + within)) for one in covariances
        ]),
    )  # fmt: skip


def _moved(skeleton: Skeleton, pose: Pose, step: Array) -> Pose:
    """Returns the pose after a step (n,) of the independent degrees of freedom, in the limits."""
    return skeleton.limits.projected(skeleton.retract(pose, step))
