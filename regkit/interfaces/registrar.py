"""Registrars: methods bound to a body, which register it to frames."""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property

import numpy as np

from regkit.body import Body
from regkit.interfaces.curvature import Curvature
from regkit.interfaces.deformation import Deformation
from regkit.interfaces.prior import Prior
from regkit.interfaces.solver import Multipliers
from regkit.observation import Observation
from regkit.primitives import Primitives
from regkit.skeleton import Pose
from regkit.system.arrays import Array
from regkit.system.brief import Brief
from regkit.system.errors import ConfigError


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
        curvature: Curvature of the energy at the pose, if the solver knows it.
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


LITTLE = 0.1
"""A point with a lower inlier probability is an outlier."""


class Registrar(Brief, ABC):
    """A method bound to a body.

    Attributes:
        body: The body.
        primitives: The primitives of the body's shape model.
    """

    body: Body
    primitives: Primitives

    @abstractmethod
    def register(
        self,
        observation: Observation,
        candidates: Sequence[Pose],
        *,
        prior: Prior | None = None,
        warm_start: RegistrationResult | None = None,
    ) -> RegistrationResult:
        """Registers the body to a frame.

        The candidate that explains the frame best is the start, and everything is bound to it.

        Args:
            observation: The frame's data.
            candidates: Candidate start poses, at least one.
            prior: What is known of the pose; by default the first candidate, as a pose alone.
            warm_start: Result of the previous frame, from which a solver may reuse more than the
                pose.
        """

    def register_each(
        self, observation: Observation, starts: Sequence[Pose], *, accuracy: float = np.inf
    ) -> list[RegistrationResult]:
        """Registers the body to one frame from each of several starts; one result for each.

        A method that prepares the frame at length may do so once, and may follow starts that have
        met only once.

        Args:
            observation: The frame's data.
            starts: The starts.
            accuracy: Root mean square distance [m] of the body's points from where they belong at
                the right start; a method need not search farther.
        """
        return [self.register(observation, [start]) for start in starts]

    @abstractmethod
    def evaluate(self, observation: Observation, pose: Pose) -> Evaluation:
        """Returns the quality of a pose for a frame without changing the pose."""

    @property
    def reads_landmarks(self) -> bool:
        """Whether the method looks at the landmarks of a frame."""
        return False

    def effective_points(self, observation: Observation, pose: Pose) -> float:
        """Returns the effective number of independent points of a frame in a registered pose.

        It is far below the number of points, because neighbouring residuals are correlated: what
        the model lacks, it lacks for all points of a limb. NaN if the method has no residuals.

        Args:
            observation: The frame's data.
            pose: The registered pose.
        """
        return float("nan")

    def gradient(self, observation: Observation, pose: Pose) -> Array:
        """Returns the derivative of the energy to a step of ``Skeleton.retract``, (n,).

        Everything is bound to the frame at this pose, which is the prior too: where it vanishes, a
        registration that starts there ends there. A method without such an energy need not have it.

        Args:
            observation: The frame's data.
            pose: The pose.

        Raises:
            ConfigError: If the method has no energy with a derivative.
        """
        raise ConfigError(
            f"{type(self).__name__} has no energy with a derivative to the pose, by which shapes "
            "are tuned; take a method of the kind that has, such as the default one"
        )

    def normal_equations(self, observation: Observation, pose: Pose) -> tuple[float, Array, Array]:
        """Returns the energy, its derivative (n,) as ``gradient``, and the curvature (n, n).

        Everything is bound to the frame at this pose.

        Args:
            observation: The frame's data.
            pose: The pose.

        Raises:
            ConfigError: If the method has no energy with a curvature.
        """
        raise ConfigError(
            f"{type(self).__name__} has no energy with a curvature, which this needs; take a "
            "method of the kind that has, such as the default one"
        )
