"""The registration problem: the energy of placed primitives over the coordinates of a pose."""

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
    """The one chain rule for all shapes, kernels, terms and solvers: forces on bones.

    Coordinates -> pose -> segments -> primitives -> energy and wrenches. On the way back the
    wrenches are accumulated on the segments, and the transposed Jacobians of the segments and of
    the coordinates map them to a gradient. Joint energies act on the degrees of freedom.

    Args:
        coordinates: Coordinates around the start pose.
        primitives: Primitives in the frames of the segments.
        similarities: The kernel, bound to the data, and the terms on primitives, by the names that
            messages use.
        joints: The terms on joints.
        multipliers: Multipliers of a similar problem's solution, for a warm start.
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
        """Returns the energy, its gradient (m,) and Gauss-Newton matrix (m, m) at x (m,).

        None if the kernel or a term has no Gauss-Newton blocks.
        """
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
        """Returns the names of the kernel and terms without Gauss-Newton blocks."""
        _, placed = self._placed(self.start)
        return tuple(
            name
            for name, similarity in self._similarities.items()
            if similarity(placed, curvature=True).stiffness is None
        )

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

    def _placed(self, x: Array) -> tuple[Placement, Placed[Primitives]]:
        # A solver evaluates next at the point that it projected, whose pose is already known.
        at, pose = self._projected
        if not np.array_equal(at, x):
            pose = self._coordinates.pose(x)
        placement = Placement.of(self._coordinates.skeleton, pose)
        return placement, self._primitives.place(placement.transforms)

    def _response(self, placed: Placed[Primitives], *, curvature: bool) -> Response:
        parts = [
            similarity(placed, curvature=curvature) for similarity in self._similarities.values()
        ]
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
