"""What a registration returns: the result of one, and the quality of a pose."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import numpy as np

from regkit.interfaces.curvature import Curvature
from regkit.interfaces.deformation import Deformation
from regkit.interfaces.solver import Multipliers
from regkit.skeleton import Pose
from regkit.system.arrays import Array

LITTLE = 0.1
"""A point with a lower inlier probability is an outlier."""


@dataclass(frozen=True)
class RegistrationResult:
    """The outcome of one registration.

    Attributes:
        pose: The registered pose.
        energy: Its energy, in the method's own units.
        inlier_share: Fraction of the points that are inliers, from 0 to 1; NaN if unknown.
        converged: Whether the solver met a tolerance.
        iterations: Number of steps of the solver.
        evaluations: Number of energy evaluations.
        message: Reason why the solver ended.
        multipliers: Multipliers of the limits, if the solver computes them.
        searched: Number of points in which the tracker sought the whole body anew; 0 if it did not.
        curvature: Curvature of the energy at the pose, if the kernel and all terms have one.
        effective_points: Effective number of independent points; NaN if it is not estimated.
        velocity: Step of ``Skeleton.retract`` to the next frame, (n,), if the tracker estimates it.
        deformation: What moves the posed body onto the data; None of a method that only poses it.
    """

    pose: Pose
    energy: float
    inlier_share: float
    converged: bool
    iterations: int
    evaluations: int
    message: str
    multipliers: Multipliers | None = None
    searched: int = 0
    curvature: Curvature | None = None
    effective_points: float = float("nan")
    velocity: Array | None = None
    deformation: Deformation | None = None

    @cached_property
    def covariance(self) -> Array | None:
        """The covariance of the degrees of freedom, (n, n); None if it is unknown.

        It is that of the step of ``Skeleton.retract`` from the pose to the true one, in [m] and
        [rad], and computed when it is first asked for.
        """
        if self.curvature is None or np.isnan(self.effective_points):
            return None
        return self.curvature.covariance(self.effective_points)

    @property
    def information(self) -> Array | None:
        """What the frame's data alone tell, (m, m), as ``Curvature.information``; or None."""
        if self.curvature is None or np.isnan(self.effective_points):
            return None
        return self.curvature.information(self.effective_points)

    @property
    def pull(self) -> Array | None:
        """How the frame's data alone pull at the pose, (m,), as ``Curvature.pull``; or None."""
        if self.curvature is None or np.isnan(self.effective_points):
            return None
        return self.curvature.pull(self.effective_points)

    @classmethod
    def given(cls, pose: Pose) -> RegistrationResult:
        """Returns the result for a given pose, which no registration found."""
        return cls(pose, np.nan, np.nan, True, 0, 0, "given")

    def without_data(self, message: str) -> RegistrationResult:
        """Returns the result for the next frame, which has no data: the same pose."""
        return RegistrationResult(self.pose, np.nan, np.nan, False, 0, 0, message)


@dataclass(frozen=True)
class Evaluation:
    """Quality of a pose for a frame.

    Attributes:
        energy: The method's energy, bound to the frame at this pose, so that different poses are
            comparable.
        inlier_probability: Inlier probability of each point, (N,), from 0 to 1; NaN if unknown.
    """

    energy: float
    inlier_probability: Array

    @property
    def inlier_share(self) -> float:
        """Fraction of points with an inlier probability of at least ``LITTLE``; NaN if unknown."""
        known = np.isfinite(self.inlier_probability).all()
        return float((self.inlier_probability >= LITTLE).mean()) if known else float("nan")
