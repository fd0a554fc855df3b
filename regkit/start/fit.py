"""Fitting a posed body to a cloud by robust least squares on their two-sided distance."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass

import numpy as np
import scipy

from regkit.body import Body
from regkit.registration import TangentCoordinates
from regkit.skeleton import Pose
from regkit.start.scan import Scan
from regkit.system.arrays import Array

STIFFNESS = 0.05
"""Weight of a joint's rotation [rad] against a distance [cutoff]; a joint without data stays."""

BEYOND = 2.0
"""Weight of a joint's violation of its limits [rad] against a distance [cutoff]."""


@dataclass(frozen=True)
class Stage:
    """One of several fits, from far to near and from stiff to loose.

    Attributes:
        cutoff: Distances much larger than this count little [m].
        stiffness: Weight of a joint's rotation [rad] against a distance [cutoff].
        evaluations: Maximum number of evaluations of the distances.
    """

    cutoff: float
    stiffness: float = STIFFNESS
    evaluations: int = 10


def fitted(scan: Scan, body: Body, pose: Pose, stages: Iterable[Stage]) -> Pose:
    """Returns the pose of least distances near ``pose``, within the joint limits.

    Hinges keep them exactly, ball joints within a few degrees.

    Args:
        scan: The cloud.
        body: The body to fit.
        pose: Initial pose.
        stages: The fits; each continues from the result of the last.
    """
    for stage in stages:
        pose = _fitted(scan, body, pose, stage)
    return pose


def _fitted(scan: Scan, body: Body, pose: Pose, stage: Stage) -> Pose:
    coordinates = TangentCoordinates(body.skeleton, pose)
    lower, upper = coordinates.bounds()
    # SciPy requires some room between the bounds, even for a hinge that must not move.
    room = np.where(upper - lower < 1e-9, 1e-9, 0.0)
    at = _ResidualsAt(scan, body, coordinates, stage)
    solution = scipy.optimize.least_squares(
        at.residuals,
        coordinates.origin(),
        jac=at.jacobian,
        bounds=(lower - room, upper + room),
        # From a start on a bound, the default method leaves it by tiny steps only.
        method="dogbox",
        loss="soft_l1",
        max_nfev=stage.evaluations,
    )
    return coordinates.pose(solution.x)


class _ResidualsAt:
    """Residuals and their Jacobian, which SciPy requests one after the other at the same point."""

    def __init__(
        self, scan: Scan, body: Body, coordinates: TangentCoordinates, stage: Stage
    ) -> None:
        self._scan, self._body, self._coordinates = scan, body, coordinates
        self._cutoff = stage.cutoff
        joints = slice(6 if body.skeleton.free else 0, None)
        self._spring = (stage.stiffness * np.eye(len(coordinates.origin())))[joints]
        self._last: tuple[Array, tuple[Array, Array]] | None = None

    def residuals(self, x: Array) -> Array:
        """Returns the residuals (R,) at x (n,)."""
        return self._at(x)[0]

    def jacobian(self, x: Array) -> Array:
        """Returns their derivative (R, n) at x (n,)."""
        return self._at(x)[1]

    def _at(self, x: Array) -> tuple[Array, Array]:
        if self._last is None or not np.array_equal(self._last[0], x):
            self._last = (x.copy(), self._evaluated(x))
        return self._last[1]

    def _evaluated(self, x: Array) -> tuple[Array, Array]:
        pose = self._coordinates.pose(x)
        placement = self._body.place(pose)
        sides = self._scan.distances(self._body, placement)
        # Both sides have the same total weight, whatever their numbers of distances.
        scales = [np.sqrt(1.0 / max(side.count, 1)) / self._cutoff for side in sides]
        residuals = [scale * side.lengths for scale, side in zip(scales, sides, strict=True)]
        rows = [scale * side.rows(placement) for scale, side in zip(scales, sides, strict=True)]
        # Bounds hold the hinges; the twist of a straight limb, which no distance holds, would turn
        # the ball joint far beyond its limits.
        violations, slopes = self._body.skeleton.violations(pose)
        residuals.append(BEYOND * violations)
        rows.append(BEYOND * slopes)
        jacobian = self._coordinates.jacobian(x)
        return (
            np.concatenate([*residuals, self._spring @ x]),
            np.concatenate([np.concatenate(rows) @ jacobian, self._spring]),
        )
