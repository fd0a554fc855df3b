"""The method that minimises a kernel's energy over the pose directly."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import Annotated, Literal

import numpy as np
from pydantic import Field, model_validator

from regkit.body import Body
from regkit.config.model import misplaced
from regkit.interfaces import (
    Fit,
    JointEnergy,
    Kernel,
    Method,
    Registered,
    Registrar,
    Scene,
    ShapeModel,
    Shares,
    Similarity,
    Solver,
    Term,
)
from regkit.observation import Observation
from regkit.primitives import Primitives
from regkit.registration.coordinates import COORDINATES, CoordinatesName
from regkit.skeleton import Pose
from regkit.system.errors import DataError
from regkit_plugins.methods.direct.bound import Bound

HARD = 1e-6
"""By how much a pose may be beyond a hard limit [rad]: what rounding makes."""

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
    terms: tuple[Term, ...] = ()
    """What is asked of a pose beyond explaining the data."""
    coordinates: CoordinatesName = "tangent"
    """What the solver moves: steps on the tangent space, or the paper's un-normalised
    quaternions."""
    hard_limits: bool = False
    """Whether a pose beyond a joint limit is never taken. It changes no result, but a solver that
    cannot promise it is refused."""
    blur: Annotated[tuple[Blur, ...], Field(min_length=1)] = (0.0,)
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

    def prepare(self, body: Body) -> DirectRegistrar:
        """Attach the shape model to the body.

        Raises:
            RegkitError: If the shape model or a term cannot be used with such a body.
        """
        for term in self.terms:
            term.check(body)
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
        self,
        observation: Observation,
        expected: Pose,
        *others: Pose,
        blurs: Sequence[float] | None = None,
        after: Registered | None = None,
    ) -> Registered:
        """The pose of least energy near the best of the given ones, through one or more blurs."""
        iterations = evaluations = 0
        pose = expected
        multipliers = None if after is None else after.multipliers
        for blur in blurs or self.method.blur:
            bound = self._bound(observation, pose, expected, blur)
            if others:
                pose = min((pose, *others), key=lambda start: bound.misfit(self.body, start))
                evaluations += 1 + len(others)
                others = ()
            # Bounds are the limits only where the start is within them.
            start = self.body.skeleton.limits.hinged(pose)
            coordinates = COORDINATES[self.method.coordinates](self.body.skeleton, start)
            problem = bound.problem(coordinates, multipliers)
            solution = self.method.solver.minimize(problem)
            pose, multipliers = coordinates.pose(solution.x), solution.multipliers
            iterations += solution.iterations
            evaluations += solution.evaluations
        if self.method.hard_limits:
            self._check_limits(pose)
        fit = Fit(solution.value, bound.explained(self.body, pose))
        return Registered(
            pose=pose,
            energy=fit.energy,
            explained=fit.share,
            converged=solution.converged,
            iterations=iterations,
            evaluations=evaluations,
            message=solution.message,
            multipliers=multipliers,
        )

    def _check_limits(self, pose: Pose) -> None:
        """Refuse what was promised not to happen.

        Raises:
            DataError: If the pose is beyond a limit.
        """
        violation = float(self.body.skeleton.limits.violation(pose).max(initial=0.0))
        if violation > HARD:
            raise DataError(
                f"solver '{self.method.solver.kind}' left the joint limits by "
                f"{np.degrees(violation):.3g} degrees, which hard_limits forbids"
            )

    def fit(self, observation: Observation, pose: Pose) -> Fit:
        """The energy in a pose, with everything bound to the frame there."""
        bound = self._bound(observation, pose, pose, 0.0)
        placed = bound.primitives.place(self.body.place(pose).transforms)
        energy = sum(similarity(placed).energy for similarity in bound.similarities)
        strain = sum(joint(pose).energy for joint in bound.joints)
        return Fit(energy + strain, bound.explained(self.body, pose))

    def _bound(self, observation: Observation, pose: Pose, expected: Pose, blur: float) -> Bound:
        """The kernel and all terms bound to a frame at a pose."""
        placed = self.primitives.place(self.body.place(pose).transforms)
        scene = Scene(self.body, observation, expected, placed)
        effects = [term.against(scene) for term in self.method.terms]
        primitives = self.primitives
        for effect in effects:
            if isinstance(effect, Shares):
                primitives = replace(primitives, weights=primitives.weights * effect.factors)
        placed = replace(placed, primitives=primitives)
        kernel = self.method.kernel.against(observation, placed, blur=blur)
        return Bound(
            primitives,
            (kernel, *(effect for effect in effects if isinstance(effect, Similarity))),
            tuple(effect for effect in effects if isinstance(effect, JointEnergy)),
        )
