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
class Registered:
    """The outcome of one registration.

    Attributes:
        pose: The pose found.
        energy: Its energy, in the method's own units.
        explained: The share of the data that it explains, from 0 to 1; NaN where the method cannot
            tell.
        converged: Whether the solver met a tolerance.
        iterations: Its steps.
        evaluations: How often it looked at the energy.
        message: Why it ended.
        multipliers: How hard the limits hold the pose, if the solver knows.
    """

    pose: Pose
    energy: float
    explained: float
    converged: bool
    iterations: int
    evaluations: int
    message: str
    multipliers: Multipliers | None = None

    @classmethod
    def given(cls, pose: Pose) -> Registered:
        """A pose that was given, not found."""
        return cls(pose, np.nan, np.nan, True, 0, 0, "given")


@dataclass(frozen=True)
class Fit:
    """How well a pose explains a frame.

    Attributes:
        energy: The method's energy there, bound to the frame at this very pose, so that poses can
            be compared with one another.
        explained: How far each point is explained, (N,), from 0 to 1.
    """

    energy: float
    explained: Array

    @property
    def share(self) -> float:
        """The share of the points that are not left to outliers all but wholly."""
        known = np.isfinite(self.explained).all()
        return float((self.explained >= BARELY).mean()) if known else float("nan")


BARELY = 0.1
"""A point that is explained by less is left to outliers: nine parts of ten are theirs."""


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
        expected: Pose,
        *others: Pose,
        blurs: Sequence[float] | None = None,
        after: Registered | None = None,
    ) -> Registered:
        """The body's pose in a frame.

        The search sets out from the pose that explains the frame best.

        Args:
            observation: The frame's data.
            expected: A pose near the one sought; where the data say nothing, it is kept.
            others: More poses from which the search may set out.
            blurs: Standard deviations [m] to smooth the energy with, one registration after the
                other; without them the method's own.
            after: The registration of the frame before, from which a solver may take more than the
                pose.
        """

    @abstractmethod
    def fit(self, observation: Observation, pose: Pose) -> Fit:
        """How well a pose explains a frame, without moving it."""
