"""The registration problem: a pose's coordinates against the energy of its placed primitives."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from functools import reduce

import numpy as np

from regkit.interfaces import (
    Constraints,
    JointEnergy,
    JointResponse,
    Multipliers,
    Problem,
    Response,
    Similarity,
)
from regkit.primitives import Placed, Primitives
from regkit.registration.coordinates import Coordinates
from regkit.skeleton import Placement
from regkit.system.arrays import Array


class RegistrationProblem(Problem):
    """Everything is forces on bones: the one chain rule for all shapes, kernels, terms and solvers.

    coordinates -> pose -> segments -> primitives -> energy and wrenches, and back: the wrenches are
    accumulated on the segments, pass through the transpose of the segments' Jacobian to the degrees
    of freedom, and from these to the coordinates. Energies of the joints join at the degrees of
    freedom.

    Args:
        coordinates: Around the start pose.
        primitives: In the frames of the segments.
        similarities: The kernel, bound to the data, and the terms that look at the primitives, by
            the names that messages call them.
        joints: The terms that look at the joints.
        multipliers: Those of a similar problem's solution.
    """

    def __init__(
        self,
        coordinates: Coordinates,
        primitives: Primitives,
        similarities: Mapping[str, Similarity],
        joints: Sequence[JointEnergy] = (),
        multipliers: Multipliers | None = None,
    ) -> None:
        self._coordinates = coordinates
        self._primitives = primitives
        self._similarities = dict(similarities)
        self._joints = tuple(joints)
        self.multipliers = multipliers
        self.start = coordinates.origin()
        self._projected = (self.start.copy(), coordinates.pose(self.start))
        self.lower, self.upper = coordinates.bounds()

    def value_and_gradient(self, x: Array) -> tuple[float, Array]:
        """Returns the energy at coordinates x (m,) and its gradient (m,), eqs. 11 to 13."""
        placement, placed = self._placed(x)
        response = self._response(placed, curvature=False)
        joints = self._joint_responses(placement)
        value, force = self._value_and_force(placement, placed, response, joints)
        return value, self._coordinates.jacobian(x).T @ force

    def normal_equations(self, x: Array) -> tuple[float, Array, Array] | None:
        """The energy, its gradient (m,) and Gauss-Newton matrix (m, m), if every part has one."""
        placement, placed = self._placed(x)
        response = self._response(placed, curvature=True)
        if response.stiffness is None:
            return None
        joints = self._joint_responses(placement)
        stiffness = placed.accumulate_stiffness(response.stiffness, len(placement.skeleton.names))
        matrix = placement.normal_matrix(stiffness)
        for joint in joints:
            matrix += joint.stiffness
        jacobian = self._coordinates.jacobian(x)
        value, force = self._value_and_force(placement, placed, response, joints)
        return value, jacobian.T @ force, jacobian.T @ matrix @ jacobian

    def without_curvature(self) -> tuple[str, ...]:
        """Returns the kernel or the terms that have no Gauss-Newton blocks."""
        _, placed = self._placed(self.start)
        return tuple(
            name
            for name, similarity in self._similarities.items()
            if similarity(placed, curvature=True).stiffness is None
        )

    def constraints(self) -> Constraints | None:
        """Returns the limits of the ball joints."""
        return self._coordinates.constraints()

    def projected(self, x: Array) -> Array:
        """The pose's hinges and balls brought back within their limits, by its one vector."""
        pose = self._coordinates.pose(x)
        within = self._coordinates.skeleton.limits.projected(pose)
        same = within is pose and self._coordinates.unique
        projected = x if same else self._coordinates.vector(within)
        self._projected = (projected.copy(), within)
        return projected

    def _placed(self, x: Array) -> tuple[Placement, Placed[Primitives]]:
        # A solver looks next at what it projected, whose pose is known already.
        at, pose = self._projected
        if not np.array_equal(at, x):
            pose = self._coordinates.pose(x)
        placement = Placement.of(self._coordinates.skeleton, pose)
        return placement, self._primitives.place(placement.transforms)

    def _response(self, placed: Placed[Primitives], *, curvature: bool) -> Response:
        parts = [one(placed, curvature=curvature) for one in self._similarities.values()]
        return reduce(Response.__add__, parts)

    def _joint_responses(self, placement: Placement) -> list[JointResponse]:
        return [energy(placement.pose) for energy in self._joints]

    def _value_and_force(
        self,
        placement: Placement,
        placed: Placed[Primitives],
        response: Response,
        joints: list[JointResponse],
    ) -> tuple[float, Array]:
        wrenches = placed.accumulate(response.wrenches, segments=len(placement.skeleton.names))
        force = placement.jacobian_transpose(wrenches)
        value = response.energy
        for joint in joints:
            force = force + joint.force
            value += joint.energy
        return value, force
