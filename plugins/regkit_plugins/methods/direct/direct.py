"""The direct method: minimises the energy of a kernel and terms over the pose."""

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
    check_field,
)
from regkit.registration import CoordinatesName, Plan
from regkit_plugins.methods.direct.bound import BoundDirect

Smoothing = Annotated[float, Field(ge=0.0, le=1e4)]


class Direct(Method):
    """Minimises the energy of a kernel and terms over the pose, near the start."""

    renamed: ClassVar[dict[str, str]] = {"blur": "annealing"}
    kind: Literal["direct"] = "direct"

    shape: ShapeModel
    """Shape model of the body's surface."""
    kernel: Kernel
    """Kernel that compares the shape model with the data."""
    solver: Solver
    """Solver that minimises the energy."""
    terms: tuple[Term, ...] = ()
    """Terms: demands on a pose besides explaining the data."""
    coordinates: CoordinatesName = "tangent"
    """Variables of the solver: steps on the tangent space, or the paper's un-normalised
    quaternions."""
    hard_limits: bool = False
    """Whether a pose that violates a joint limit is an error. The option does not change results,
    and requires a solver that satisfies all joint limits."""
    annealing: Annotated[tuple[Smoothing, ...], Field(min_length=1)] = (0.0,)
    """Standard deviations of the smoothing of the energy [m], for one solution after the other.
    Smoothing beyond a limb's radius may lose the limbs."""

    compiled: bool = True
    """Whether a frame is registered by compiled functions where all parts offer them. The result is
    the same up to rounding in single precision; the other way is for reading and comparing."""

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

    def shape_model(self) -> ShapeModel:
        """Returns the shape model."""
        return self.shape

    def check(self, body: Body) -> None:
        """Checks that the tracker and the terms fit a body.

        Raises:
            FieldError: If one of their fields does not.
        """
        super().check(body)
        for index, term in enumerate(self.terms):
            check_field(term.check, body, "terms", index)

    def bind(self, body: Body) -> BoundDirect:
        """Binds the method to a body: makes the primitives and checks the terms.

        Raises:
            RegkitError: If the shape model or a term does not support the body.
        """
        self.check(body)
        primitives = self.shape.bind(body)
        plan = Plan.of(body, primitives, self.kernel, self.terms) if self.compiled else None
        solvable = self.solver.minimizes_plans and self.coordinates == "tangent"
        return BoundDirect(self, body, primitives, plan if solvable else None, plan)
