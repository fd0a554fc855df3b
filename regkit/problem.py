"""The registration problem: a pose's coordinates against the energy of its placed primitives."""

from __future__ import annotations

from regkit.arrays import Array
from regkit.coordinates import Coordinates
from regkit.interfaces import Problem, Response, Similarity
from regkit.primitives import Placed, Primitives
from regkit.skeleton import Placement


class RegistrationProblem(Problem):
    """Everything is forces on bones: the one chain rule for all shapes, kernels and solvers.

    coordinates -> pose -> segments -> primitives -> energy and wrenches, and back: the wrenches are
    gathered on the segments, pulled back to the degrees of freedom, and from these to the
    coordinates.

    Args:
        coordinates: Around the start pose.
        primitives: In the frames of the segments.
        similarity: The kernel, bound to the data.
    """

    def __init__(
        self, coordinates: Coordinates, primitives: Primitives, similarity: Similarity
    ) -> None:
        self._coordinates = coordinates
        self._primitives = primitives
        self._similarity = similarity
        self.start = coordinates.origin()
        self.lower, self.upper = coordinates.bounds()

    def value_and_gradient(self, x: Array) -> tuple[float, Array]:
        """The energy at coordinates x (m,) and its gradient (m,), eqs. 11 to 13."""
        placement, placed = self._placed(x)
        response = self._similarity(placed)
        return response.energy, self._gradient(x, placement, placed, response)

    def normal_equations(self, x: Array) -> tuple[float, Array, Array] | None:
        """The energy, its gradient (m,) and Gauss-Newton matrix (m, m), if the kernel has one."""
        placement, placed = self._placed(x)
        response = self._similarity(placed, curvature=True)
        if response.stiffness is None:
            return None
        stiffness = placed.gather_stiffness(response.stiffness, len(placement.skeleton.names))
        differential = self._coordinates.differential(x)
        matrix = differential.T @ placement.normal_matrix(stiffness) @ differential
        return response.energy, self._gradient(x, placement, placed, response), matrix

    def projected(self, x: Array) -> Array:
        """The pose's hinges and balls brought back within their limits."""
        pose = self._coordinates.pose(x)
        within = self._coordinates.skeleton.limits.projected(pose)
        return x if within is pose else self._coordinates.vector(within)

    def _placed(self, x: Array) -> tuple[Placement, Placed[Primitives]]:
        placement = Placement.of(self._coordinates.skeleton, self._coordinates.pose(x))
        return placement, self._primitives.place(placement.transforms)

    def _gradient(
        self, x: Array, placement: Placement, placed: Placed[Primitives], response: Response
    ) -> Array:
        wrenches = placed.gather(response.wrenches, segments=len(placement.skeleton.names))
        return self._coordinates.differential(x).T @ placement.pull_back(wrenches)
