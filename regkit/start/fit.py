"""Fitting a posed body to a cloud by robust least squares on their gaps."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass

import numpy as np
from scipy.optimize import least_squares

from regkit.body import Body
from regkit.geometry.rotation import cross
from regkit.registration.coordinates import TangentCoordinates
from regkit.skeleton import Placement, Pose
from regkit.start.scan import Gaps, Scan
from regkit.system.arrays import Array

STIFFNESS = 0.05
"""Weight of a joint's turn [rad] against a gap [reach]: what nothing pulls keeps its stance."""


@dataclass(frozen=True)
class Stage:
    """One fit of several, from far to near and from stiff to loose.

    Attributes:
        reach: Gaps much larger than this [m] hardly count.
        stiffness: Weight of a joint's turn [rad] against a gap [reach].
        evaluations: How often the gaps are looked at, at most.
    """

    reach: float
    stiffness: float = STIFFNESS
    evaluations: int = 10


def fitted(scan: Scan, body: Body, pose: Pose, stages: Iterable[Stage]) -> Pose:
    """The pose of least gaps near ``pose``, its hinges within their limits.

    Args:
        scan: The cloud.
        body: What is fitted.
        pose: Where to begin.
        stages: One fit after the other, each from where the last one ended.
    """
    for stage in stages:
        pose = _fitted(scan, body, pose, stage)
    return pose


def _fitted(scan: Scan, body: Body, pose: Pose, stage: Stage) -> Pose:
    coordinates = TangentCoordinates(body.skeleton, pose)
    lower, upper = coordinates.bounds()
    # SciPy wants some room between the bounds, even for a hinge that is not to move.
    room = np.where(upper - lower < 1e-9, 1e-9, 0.0)
    gaps = _GapsAt(scan, body, coordinates, stage)
    solution = least_squares(
        gaps.residuals,
        coordinates.origin(),
        jac=gaps.jacobian,
        bounds=(lower - room, upper + room),
        # The default method leaves a bound on which it starts by tiny steps only.
        method="dogbox",
        loss="soft_l1",
        max_nfev=stage.evaluations,
    )
    return coordinates.pose(solution.x)


class _GapsAt:
    """Residuals and their Jacobian, which SciPy asks for one after the other at the same point."""

    def __init__(
        self, scan: Scan, body: Body, coordinates: TangentCoordinates, stage: Stage
    ) -> None:
        self._scan, self._body, self._coordinates = scan, body, coordinates
        self._reach = stage.reach
        joints = slice(6 if body.skeleton.free else 0, None)
        self._spring = (stage.stiffness * np.eye(len(coordinates.origin())))[joints]
        self._last: tuple[Array, tuple[Array, Array]] | None = None

    def residuals(self, x: Array) -> Array:
        """Residuals (R,) at x (n,)."""
        return self._at(x)[0]

    def jacobian(self, x: Array) -> Array:
        """Their derivative (R, n)."""
        return self._at(x)[1]

    def _at(self, x: Array) -> tuple[Array, Array]:
        if self._last is None or not np.array_equal(self._last[0], x):
            self._last = (x.copy(), self._evaluated(x))
        return self._last[1]

    def _evaluated(self, x: Array) -> tuple[Array, Array]:
        placement = self._body.place(self._coordinates.pose(x))
        sides = (
            self._scan.unexplained(self._body, placement),
            self._scan.unseen(self._body, placement),
        )
        gaps = [_weight(side) / self._reach * side.lengths for side in sides]
        rows = [_weight(side) / self._reach * _rows(side, placement) for side in sides]
        jacobian = self._coordinates.jacobian(x)
        return (
            np.concatenate([*gaps, self._spring @ x]),
            np.concatenate([np.concatenate(rows) @ jacobian, self._spring]),
        )


def _weight(side: Gaps) -> float:
    """Both sides count alike, however many gaps they have."""
    return float(np.sqrt(1.0 / len(side.lengths)))


def _rows(side: Gaps, placement: Placement) -> Array:
    """The derivative (R, n) of the gaps to the degrees of freedom."""
    jacobian = placement.jacobian[side.segments]
    arms = side.points - placement.transforms[side.segments, :3, 3]
    wrenches = np.concatenate([side.directions, cross(arms, side.directions)], axis=1)
    return np.asarray((wrenches[:, None, :] @ jacobian)[:, 0])
