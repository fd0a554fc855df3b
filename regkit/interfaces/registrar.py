"""Registrars: methods made ready for a body, which find its pose in a frame."""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from regkit.body import Body
from regkit.interfaces.solver import Multipliers
from regkit.observation import Observation
from regkit.primitives import Primitives
from regkit.skeleton import Pose
from regkit.system.arrays import Array


@dataclass(frozen=True)
class RegistrationResult:
    """The outcome of one registration.

    Attributes:
        pose: The pose found.
        energy: Its energy, in the method's own units.
        inlier_share: Share of the points that are inliers, from 0 to 1; NaN where the method cannot
            tell.
        converged: Whether the solver met a tolerance.
        iterations: Its steps.
        evaluations: How often it looked at the energy.
        message: Why it ended.
        multipliers: How hard the limits hold the pose, if the solver knows.
    """

    pose: Pose
    energy: float
    inlier_share: float
    converged: bool
    iterations: int
    evaluations: int
    message: str
    multipliers: Multipliers | None = None

    @classmethod
    def given(cls, pose: Pose) -> RegistrationResult:
        """Returns a pose that was given, not found."""
        return cls(pose, np.nan, np.nan, True, 0, 0, "given")


@dataclass(frozen=True)
class Evaluation:
    """How well a pose explains a frame.

    Attributes:
        energy: The method's energy there, bound to the frame at this very pose, so that poses can
            be compared with one another.
        inlier_probability: Of each point, (N,), from 0 to 1.
    """

    energy: float
    inlier_probability: Array

    @property
    def inlier_share(self) -> float:
        """The share of the points that are inliers with more than little probability."""
        known = np.isfinite(self.inlier_probability).all()
        return float((self.inlier_probability >= LITTLE).mean()) if known else float("nan")


LITTLE = 0.1
"""A point of less inlier probability counts as an outlier."""


class Registrar(ABC):
    """A method made ready for one body.

    Attributes:
        body: The body.
        primitives: What its shape model made of the body.
    """

    body: Body
    primitives: Primitives

    @abstractmethod
    def register(
        self,
        observation: Observation,
        candidates: Sequence[Pose],
        *,
        prior: Pose | None = None,
        warm_start: RegistrationResult | None = None,
    ) -> RegistrationResult:
        """Returns the body's pose in a frame.

        The search starts from the candidate that explains the frame best, and everything is bound
        to that candidate.

        Args:
            observation: The frame's data.
            candidates: Poses from which the search may start, one at least.
            prior: The pose that is kept where the data say nothing; the first candidate without it.
            warm_start: The result of the frame before, from which a solver may take more than the
                pose.
        """

    @abstractmethod
    def evaluate(self, observation: Observation, pose: Pose) -> Evaluation:
        """How well a pose explains a frame, without moving it."""
