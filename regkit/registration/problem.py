"""The registration problem: a pose's coordinates against the energy of its placed primitives."""

from __future__ import annotations

from collections.abc import Sequence
from functools import reduce

from regkit.interfaces import (
    Constraints,
    JointEnergy,
    Multipliers,
    Problem,
    Response,
    Similarity,
    Strain,
)
from regkit.primitives import Placed, Primitives
from regkit.registration.coordinates import Coordinates
from regkit.skeleton import Placement
from regkit.system.arrays import Array


class RegistrationProblem(Problem):
    """Everything is forces on bones: the one chain rule for all shapes, kernels, terms and solvers.

    coordinates -> pose -> segments -> primitives -> energy and wrenches, and back: the wrenches are
    gathered on the segments, pulled back to the degrees of freedom, and from these to the
    coordinates. Energies of the joints join at the degrees of freedom.

    Args:
        coordinates: Around the start pose.
        primitives: In the frames of the segments.
        similarities: The kernel, bound to the data, and the terms that look at the primitives.
        joints: The terms that look at the joints.
        multipliers: Those of a similar problem's solution.
    """

    def __init__(
        self,
        coordinates: Coordinates,
        primitives: Primitives,
        similarities: Sequence[Similarity],
        joints: Sequence[JointEnergy] = (),
        multipliers: Multipliers | None = None,
    ) -> None:
        self._coordinates = coordinates
        self._primitives = primitives
        self._similarities = tuple(similarities)
        self._joints = tuple(joints)
        self.multipliers = multipliers
        self.start = coordinates.origin()
        self._last = (self.start, coordinates.pose(self.start))
        self.lower, self.upper = coordinates.bounds()

    def value_and_gradient(self, x: Array) -> tuple[float, Array]:
        """The energy at coordinates x (m,) and its gradient (m,), eqs. 11 to 13."""
        placement, placed = self._placed(x)
        response = self._response(placed, curvature=False)
        value, force = self._value_and_force(placement, placed, response, self._strains(placement))
        return value, self._coordinates.differential(x).T @ force

    def normal_equations(self, x: Array) -> tuple[float, Array, Array] | None:
        """The energy, its gradient (m,) and Gauss-Newton matrix (m, m), if the kernel has one."""
        placement, placed = self._placed(x)
        response = self._response(placed, curvature=True)
        if response.stiffness is None:
            return None
        strains = self._strains(placement)
        stiffness = placed.gather_stiffness(response.stiffness, len(placement.skeleton.names))
        matrix = placement.normal_matrix(stiffness)
        for strain in strains:
            matrix += strain.stiffness
        differential = self._coordinates.differential(x)
        value, force = self._value_and_force(placement, placed, response, strains)
        return value, differential.T @ force, differential.T @ matrix @ differential

    def constraints(self) -> Constraints | None:
        """The limits of the ball joints."""
        return self._coordinates.constraints()

    def projected(self, x: Array) -> Array:
        """The pose's hinges and balls brought back within their limits, by its one vector."""
        pose = self._coordinates.pose(x)
        within = self._coordinates.skeleton.limits.projected(pose)
        kept = within is pose and self._coordinates.unique
        projected = x if kept else self._coordinates.vector(within)
        self._last = (projected, within)
        return projected

    def _placed(self, x: Array) -> tuple[Placement, Placed[Primitives]]:
        # What was projected is looked at next, and its pose is known then.
        at, pose = self._last
        if at is not x:
            pose = self._coordinates.pose(x)
        placement = Placement.of(self._coordinates.skeleton, pose)
        return placement, self._primitives.place(placement.transforms)

    def _response(self, placed: Placed[Primitives], *, curvature: bool) -> Response:
        parts = [similarity(placed, curvature=curvature) for similarity in self._similarities]
        return reduce(Response.__add__, parts)

    def _strains(self, placement: Placement) -> list[Strain]:
        return [energy(placement.pose) for energy in self._joints]

    def _value_and_force(
        self,
        placement: Placement,
        placed: Placed[Primitives],
        response: Response,
        strains: list[Strain],
    ) -> tuple[float, Array]:
        wrenches = placed.gather(response.wrenches, segments=len(placement.skeleton.names))
        force = placement.pull_back(wrenches)
        value = response.energy
        for strain in strains:
            force = force + strain.force
            value += strain.energy
        return value, force
