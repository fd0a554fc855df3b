"""The registration problem: a pose's coordinates against the energy of its placed primitives."""

from __future__ import annotations

from regkit.arrays import Array
from regkit.coordinates import Coordinates
from regkit.interfaces import Problem, Similarity
from regkit.primitives import Primitives
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
        skeleton = self._coordinates.skeleton
        placement = Placement.of(skeleton, self._coordinates.pose(x))
        placed = self._primitives.place(placement.transforms)
        response = self._similarity(placed)
        wrenches = placed.gather(response.wrenches, segments=len(skeleton.names))
        force = placement.pull_back(wrenches)
        return response.energy, self._coordinates.differential(x).T @ force
