"""A robot's base with its covariance, and the poses of the cameras in its frame."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import numpy as np

from regkit.body import Body, BodyFit
from regkit.body.verdict import Verdict, frame_verdict
from regkit.geometry.rigid import inverse
from regkit.geometry.rotation import from_matrix, skew, to_vector
from regkit.observation import Observation
from regkit.skeleton import Pose
from regkit.system.arrays import Array

POOR = 0.6
"""A base is doubtful if the robot is surely found in a smaller fraction of the frames."""

MOVES, TURNS = 0.05, np.radians(6.0)
"""A base that is this much elsewhere in half of the frames alone, in sizes of the robot and [rad],
may not stand still."""

LOOSE, SKEW = 0.02, np.radians(3.0)
"""A base is doubtful if its standard deviation is larger, in sizes of the robot and [rad]."""


@dataclass(frozen=True)
class CameraInBase:
    """The pose of a camera in the frame of a robot's base.

    Attributes:
        T_base_camera: The pose, (4, 4) [m].
        covariance: Covariance (6, 6) of a step to the true pose: a translation [m] in the base's
            frame, then a rotation vector [rad] in the camera's.
    """

    T_base_camera: Array
    covariance: Array

    @property
    def deviations(self) -> Array:
        """Standard deviations (6,) of the position [m] and the rotation [rad]."""
        return np.asarray(np.sqrt(np.diag(self.covariance)))

    def in_axes(self, R_new_base: Array) -> CameraInBase:
        """Returns the same pose with other axes of the base's frame.

        Args:
            R_new_base: The base's axes in the new ones, (3, 3).
        """
        transform = self.T_base_camera.copy()
        transform[:3] = R_new_base @ transform[:3]
        turn = np.eye(6)
        turn[:3, :3] = R_new_base
        return CameraInBase(transform, turn @ self.covariance @ turn.T)


@dataclass(frozen=True)
class FoundBase:
    """The pose of a base that stands still, with what supports it.

    Attributes:
        body: The robot at its size, with a free root.
        T_world_base: The pose of its root in the world, which is the only camera's frame or that of
            the recording of several cameras, (4, 4) [m].
        covariance: Covariance (6, 6) of a step of ``Skeleton.retract`` to the true pose.
        cameras: T_world_camera (4, 4) [m] by the cameras' names; of a single camera the name is
            empty.
        poses: Pose of the robot in each frame that was used.
        distance: Median distance of the points of these frames to the robot [m].
        verdict: Whether the base is found.
        reason: Why it is not surely found; empty if it is.
    """

    body: Body
    T_world_base: Array
    covariance: Array
    cameras: Mapping[str, Array]
    poses: Sequence[Pose]
    distance: float
    verdict: Verdict
    reason: str = ""

    def in_base(self, name: str) -> CameraInBase:
        """Returns the pose of a camera in the base's frame."""
        T_world_camera = self.cameras[name]
        T_base_world = inverse(self.T_world_base)
        turn = self.T_world_base[:3, :3]
        # A step (t, w) of T_world_base moves its inverse by (-R^T t + [p] w, -R w).
        jacobian = np.zeros((6, 6))
        jacobian[:3, :3] = -turn.T
        jacobian[:3, 3:] = skew(T_base_world[:3, 3])
        jacobian[3:, 3:] = -turn
        # A step (t, w) of T_base_world moves T_base_camera by (t - R [q] w, Q^T w).
        onward = np.eye(6)
        onward[:3, 3:] = -T_base_world[:3, :3] @ skew(T_world_camera[:3, 3])
        onward[3:, 3:] = T_world_camera[:3, :3].T
        jacobian = onward @ jacobian
        covariance = jacobian @ self.covariance @ jacobian.T
        return CameraInBase(T_base_world @ T_world_camera, np.asarray(covariance))


def judged(
    body: Body,
    frames: Sequence[Observation],
    poses: Sequence[Pose],
    alone: Array,
    covariance: Array,
    *,
    rested: bool,
) -> tuple[Verdict, str, float]:
    """Returns the verdict of a base, the reason, and the points' distance [m].

    Args:
        body: The robot.
        frames: The data of the frames.
        poses: Its poses with the common base.
        alone: T_world_base of each frame by itself, (F, 4, 4).
        covariance: Covariance of the base, (6, 6).
        rested: Whether the base came to rest.
    """
    verdicts, distances = [], []
    for frame, pose in zip(frames, poses, strict=True):
        fit = BodyFit.of(body, pose, frame.points, frame.sight)
        shares = (fit.inlier_share, fit.coverage, fit.misfit, fit.relief)
        verdicts.append(frame_verdict(len(frame.points), *shares))
        distances.append(fit.distance)
    reasons = []
    surely = float(np.mean([one is Verdict.FOUND for one in verdicts]))
    if surely < POOR:
        reasons.append(f"the robot is surely found in {100.0 * surely:.0f} % of the frames only")
    off = inverse(poses[0].root) @ alone
    apart = float(np.median(np.linalg.norm(off[:, :3, 3], axis=1)))
    turned = float(np.median(np.linalg.norm(to_vector(from_matrix(off[:, :3, :3])), axis=1)))
    if apart > MOVES * body.size or turned > TURNS:
        reasons.append(
            f"in half of the frames alone the base is {100.0 * apart:.1f} cm or "
            f"{np.degrees(turned):.1f} degrees from the common one; it may not stand still"
        )
    deviations = np.sqrt(np.diag(covariance))
    place, turn = float(deviations[:3].max()), float(deviations[3:].max())
    if place > LOOSE * body.size or turn > SKEW:
        reasons.append(
            f"the data determine the base within {1000.0 * place:.1f} mm and "
            f"{np.degrees(turn):.2g} degrees only (standard deviation)"
        )
    if not rested:
        reasons.append("the base still moves from one solution to the next")
    verdict = Verdict.DOUBTFUL if reasons else Verdict.FOUND
    return verdict, "; ".join(reasons), float(np.median(distances))
