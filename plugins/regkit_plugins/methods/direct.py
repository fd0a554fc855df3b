"""The method that minimises a kernel's energy over the pose directly."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Annotated, Literal

from pydantic import Field, model_validator

from regkit.body import Body
from regkit.coordinates import COORDINATES, CoordinatesName
from regkit.interfaces import Kernel, Method, Registered, Registrar, ShapeModel, Solver
from regkit.observation import Observation
from regkit.primitives import Primitives
from regkit.problem import RegistrationProblem
from regkit.skeleton import Pose

Blur = Annotated[float, Field(ge=0.0)]


class Direct(Method):
    """A shape model, a kernel and a solver: the pose of least energy near the start."""

    kind: Literal["direct"] = "direct"

    shape: ShapeModel
    """What stands for the body's surface."""
    kernel: Kernel
    """What compares it with the data."""
    solver: Solver
    """What makes the energy small."""
    coordinates: CoordinatesName = "tangent"
    """What the solver moves: steps on the tangent space, or the paper's un-normalised
    quaternions."""
    blur: Annotated[tuple[Blur, ...], Field(min_length=1)] = (0.0,)
    """Annealing: standard deviations [m] that smooth the energy, one solution after the other.
    Beyond a limb's radius the limbs get lost."""

    @model_validator(mode="after")
    def _shape_fits_kernel(self) -> Direct:
        if not issubclass(self.shape.makes, self.kernel.accepts):
            raise ValueError(
                f"kernel '{self.kernel.kind}' compares {self.kernel.accepts.__name__}, but shape "
                f"'{self.shape.kind}' makes {self.shape.makes.__name__}"
            )
        return self

    def prepare(self, body: Body) -> DirectRegistrar:
        """Attach the shape model to the body."""
        return DirectRegistrar(self, body, self.shape.attach(body))


@dataclass(frozen=True)
class DirectRegistrar(Registrar):
    """``Direct`` for one body.

    Attributes:
        method: Its configuration.
        body: The body.
        primitives: Its shape model's primitives.
    """

    method: Direct
    body: Body
    primitives: Primitives

    def register(
        self, observation: Observation, start: Pose, *, blurs: Sequence[float] | None = None
    ) -> Registered:
        """The pose of least energy near ``start``, through one or more blurs."""
        iterations = evaluations = 0
        pose = start
        for blur in blurs or self.method.blur:
            placed = self.primitives.place(self.body.place(pose).transforms)
            similarity = self.method.kernel.against(observation, placed, blur=blur)
            coordinates = COORDINATES[self.method.coordinates](self.body.skeleton, pose)
            problem = RegistrationProblem(coordinates, self.primitives, similarity)
            solution = self.method.solver.minimize(problem)
            pose = coordinates.pose(solution.x)
            iterations += solution.iterations
            evaluations += solution.evaluations
        return Registered(
            pose, solution.value, solution.converged, iterations, evaluations, solution.message
        )
