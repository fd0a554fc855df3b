"""The registration problem: the energy of placed primitives over the coordinates of a pose."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from functools import reduce

from regkit.interfaces import JointEnergy, JointResponse, Multipliers, Response, Similarity
from regkit.primitives import Placed, Primitives
from regkit.registration.coordinates import Coordinates
from regkit.registration.pose_problem import PoseProblem
from regkit.skeleton import Placement, Pose
from regkit.system.arrays import Array


class RegistrationProblem(PoseProblem):
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
        super().__init__(coordinates, multipliers)
        self._primitives = primitives
        self._similarities = dict(similarities)
        self._joints = tuple(joints)

    def without_curvature(self) -> tuple[str, ...]:
        """Returns the names of the kernel and terms without Gauss-Newton blocks."""
        _, placed = self._placed(self._coordinates.pose(self.start))
        return tuple(
            name
            for name, similarity in self._similarities.items()
            if similarity(placed, curvature=True).stiffness is None
        )

    def value_and_force(self, pose: Pose) -> tuple[float, Array]:
        """Returns the energy of a pose and its derivative to the degrees of freedom (n,)."""
        placement, placed = self._placed(pose)
        response = self._response(placed, curvature=False)
        return self._value_and_force(placement, response, self._joint_responses(placement))

    def value_force_and_matrix(self, pose: Pose) -> tuple[float, Array, Array] | None:
        """Returns energy, force (n,) and Gauss-Newton matrix (n, n); None without blocks."""
        placement, placed = self._placed(pose)
        response = self._response(placed, curvature=True)
        if response.stiffness is None:
            return None
        joints = self._joint_responses(placement)
        matrix = placement.normal_matrix(response.stiffness)
        for joint in joints:
            matrix += joint.stiffness
        return *self._value_and_force(placement, response, joints), matrix

    def _placed(self, pose: Pose) -> tuple[Placement, Placed[Primitives]]:
        placement = Placement.of(self._coordinates.skeleton, pose)
        return placement, self._primitives.place(placement.transforms)

    def _response(self, placed: Placed[Primitives], *, curvature: bool) -> Response:
        segments = len(self._coordinates.skeleton.names)
        parts = [
            similarity.on_segments(placed, segments, curvature=curvature)
            for similarity in self._similarities.values()
        ]
        return reduce(Response.__add__, parts)

    def _joint_responses(self, placement: Placement) -> list[JointResponse]:
        return [energy(placement.pose) for energy in self._joints]

    def _value_and_force(
        self, placement: Placement, response: Response, joints: list[JointResponse]
    ) -> tuple[float, Array]:
        force = placement.jacobian_transpose(response.wrenches)
        value = response.energy
        for joint in joints:
            force = force + joint.force
            value += joint.energy
        return value, force
