"""Problems over the coordinates of a pose."""

from __future__ import annotations

from abc import abstractmethod

import numpy as np

from regkit.interfaces import Constraints, Multipliers, Problem
from regkit.registration.coordinates import Coordinates
from regkit.skeleton import Pose
from regkit.system.arrays import Array


class PoseProblem(Problem):
    """An energy of the pose over its coordinates; a subclass defines the energy.

    Args:
        coordinates: Coordinates around the start pose.
        multipliers: Multipliers of a similar problem's solution, for a warm start.
    """

    def __init__(self, coordinates: Coordinates, multipliers: Multipliers | None = None) -> None:
        self._coordinates = coordinates
        self.multipliers = multipliers
        self.start = coordinates.origin()
        self._projected: tuple[Array, Pose] | None = None
        self.lower, self.upper = coordinates.bounds()

    @abstractmethod
    def value_and_force(self, pose: Pose) -> tuple[float, Array]:
        """Returns the energy of a pose and its derivative to the degrees of freedom (n,)."""

    @abstractmethod
    def value_force_and_matrix(self, pose: Pose) -> tuple[float, Array, Array] | None:
        """Returns energy, force (n,) and Gauss-Newton matrix (n, n); None without a matrix."""

    def value_and_gradient(self, x: Array) -> tuple[float, Array]:
        """Returns the energy at coordinates x (m,) and its gradient (m,), eqs. 11 to 13."""
        value, force = self.value_and_force(self._pose(x))
        return value, self._coordinates.jacobian(x).T @ force

    def normal_equations(self, x: Array) -> tuple[float, Array, Array] | None:
        """Returns the energy, its gradient (m,) and Gauss-Newton matrix (m, m) at x (m,).

        None if the kernel or a term has no Gauss-Newton blocks.
        """
        found = self.value_force_and_matrix(self._pose(x))
        if found is None:
            return None
        value, force, matrix = found
        jacobian = self._coordinates.jacobian(x)
        return value, jacobian.T @ force, jacobian.T @ matrix @ jacobian

    def constraints(self) -> Constraints | None:
        """Returns the limits of the ball joints as constraints; None without any."""
        return self._coordinates.constraints()

    def projected(self, x: Array) -> Array:
        """Returns coordinates (m,) with hinges and ball joints projected onto their limits."""
        pose = self._coordinates.pose(x)
        within = self._coordinates.skeleton.limits.projected(pose)
        same = within is pose and self._coordinates.unique
        projected = x if same else self._coordinates.vector(within)
        self._projected = (projected.copy(), within)
        return projected

    def _pose(self, x: Array) -> Pose:
        # A solver evaluates next at the point that it projected, whose pose is already known.
        if self._projected is not None:
            at, pose = self._projected
            if np.array_equal(at, x):
                return pose
        return self._coordinates.pose(x)
