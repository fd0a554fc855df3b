"""The method that minimises a kernel's energy over the pose directly."""

from __future__ import annotations

from typing import Annotated, ClassVar, Literal

from pydantic import Field, model_validator

from regkit.body import Body
from regkit.config.model import misplaced
from regkit.interfaces import (
    Kernel,
    Method,
    ShapeModel,
    Solver,
    Term,
)
from regkit.registration import CoordinatesName
from regkit_plugins.methods.direct.bound import BoundDirect

Smoothing = Annotated[float, Field(ge=0.0)]


class Direct(Method):
    """A shape model, a kernel and a solver: the pose of least energy near the start."""

    renamed: ClassVar[dict[str, str]] = {"blur": "annealing"}
    kind: Literal["direct"] = "direct"

    shape: ShapeModel
    """What stands for the body's surface."""
    kernel: Kernel
    """What compares it with the data."""
    solver: Solver
    """What makes the energy small."""
    terms: tuple[Term, ...] = ()
    """What is asked of a pose beyond explaining the data."""
    coordinates: CoordinatesName = "tangent"
    """What the solver moves: steps on the tangent space, or the paper's un-normalised
    quaternions."""
    hard_limits: bool = False
    """Whether a pose beyond a joint limit is never taken. It changes no result, but a solver that
    cannot promise it is refused."""
    annealing: Annotated[tuple[Smoothing, ...], Field(min_length=1)] = (0.0,)
    """Annealing: standard deviations [m] that smooth the energy, one solution after the other.
    Beyond a limb's radius the limbs get lost."""

    @model_validator(mode="after")
    def _shape_fits_kernel(self) -> Direct:
        self.kernel.check_shape(self.shape)
        return self

    @model_validator(mode="after")
    def _solver_keeps_hard_limits(self) -> Direct:
        if self.hard_limits and not self.solver.limits.hard:
            raise misplaced(
                type(self),
                f"solver '{self.solver.kind}' does not keep the limits of ball joints (they do: "
                f"{', '.join(Solver.keeping_limits())}); take one of these, or leave hard_limits "
                "out",
                "solver",
            )
        return self

    @model_validator(mode="after")
    def _terms_fit_shape(self) -> Direct:
        for term in self.terms:
            if not issubclass(self.shape.makes, term.accepts):
                raise ValueError(
                    f"term '{term.kind}' looks at {term.accepts.__name__}, but shape "
                    f"'{self.shape.kind}' makes {self.shape.makes.__name__}; leave it out"
                )
        return self

    def bind(self, body: Body) -> BoundDirect:
        """Make the primitives, and check what the terms ask for.

        Raises:
            RegkitError: If the shape model or a term cannot be used with such a body.
        """
        for term in self.terms:
            term.check(body)
        return BoundDirect(self, body, self.shape.bind(body))
