"""Priors: what is known of a pose before its frame is seen."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import numpy as np

from regkit.interfaces.compiled import PriorArrays
from regkit.skeleton import Pose
from regkit.skeleton.arrays import PoseArrays
from regkit.system.arrays import Array
from regkit.system.brief import Brief


@dataclass(frozen=True)
class Prior(Brief):
    """A Gaussian on the tangent space of ``Skeleton.retract``, or a pose alone.

    An energy is a mean over the points. With the effective number N of independent points, N times
    the energy is minus a log-likelihood, to which the prior adds 1/2 d^T L d: its information L
    counts L / N in the energy's unit.

    Attributes:
        pose: The mean: the pose to which joints without data stay close.
        information: L, inverse of the covariance at ``pose``, (n, n); None for a pose alone.
        points: N, of the frame that is registered; NaN if it is unknown.
    """

    pose: Pose
    information: Array | None = None
    points: float = float("nan")

    @property
    def informed(self) -> bool:
        """Whether it is a Gaussian, and so more than a pose."""
        return self.information is not None

    @property
    def stiffness(self) -> Array | None:
        """L / N, the information in the unit of an energy, (n, n); None for a pose alone."""
        return None if self.information is None else self.information / self.points

    @cached_property
    def arrays(self) -> PriorArrays:
        """The prior as compiled functions take it."""
        stiffness = self.stiffness
        return PriorArrays(
            PoseArrays.of(self.pose),
            np.empty((0, 0)) if stiffness is None else stiffness,
        )
