"""Gauss-Newton on the errors in which a tracker ends, stopped early by held-out samples."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from regkit.system.arrays import Array
from regkit.tuning.crew import Crew
from regkit.tuning.rollouts import robust_costs

TRAINING, HELD_OUT = "training", "held-out"
"""Names of the sets of samples."""

LARGEST = 2.0
"""Largest step of a parameter, in its unit."""

TRIALS = 5
"""Number of steps that are tried, each shorter, before the descent ends."""

PATIENCE = 3
"""Number of iterations without improvement on held-out samples before the descent ends."""

SLIGHT = 1e-3
"""A step that decreases the cost by a smaller fraction is the last."""

LEAST, FIRST = 1e-3, 1e-2
"""Least and first damping, as fractions of the matrix's diagonal."""


@dataclass(frozen=True)
class Step:
    """The costs after one step of a descent.

    Attributes:
        training: Mean cost of a sample, with the penalty, in squared radii of a typical limb.
        held_out: Mean cost of a held-out sample.
    """

    training: float
    held_out: float


@dataclass(frozen=True)
class Descent:
    """A search for shape parameters.

    Attributes:
        crew: The processes, which have a training set and a held-out set.
        radius: Radius of a typical limb [m].
        prior: Weight of the squared parameters, which keep near the primitives before tuning.
        iterations: Maximum number of steps.
    """

    crew: Crew
    radius: float
    prior: float
    iterations: int

    def found(self, tell: Callable[[Step], None]) -> Array:
        """Returns the parameters (F,) with the least cost on the held-out set.

        Args:
            tell: Called with each step; the first is the start.
        """
        parameters = self.crew.tunable.start()
        cost, damping = self._cost(parameters), FIRST
        best, least, waited = parameters, self._held_out(parameters), 0
        tell(Step(cost, least))
        for _ in range(self.iterations):
            accepted = self._stepped(parameters, cost, damping)
            if accepted is None:
                break
            gain = cost - accepted[1]
            parameters, cost, damping = accepted
            held_out = self._held_out(parameters)
            tell(Step(cost, held_out))
            waited = 0 if held_out < least else waited + 1
            if held_out < least:
                best, least = parameters, held_out
            if waited == PATIENCE or gain < SLIGHT * cost:
                break
        return best

    def _stepped(
        self, parameters: Array, cost: float, damping: float
    ) -> tuple[Array, float, float] | None:
        """Returns the parameters after a step that decreases the cost, that cost, and the damping.

        None if no step does.
        """
        equations = self.crew.normal_equations(TRAINING, parameters)
        matrix = equations.matrix / equations.frames
        gradient = equations.gradient / equations.frames + 2.0 * self.prior * parameters
        diagonal = matrix.diagonal()
        spread = diagonal + 0.02 * diagonal.mean()
        for _ in range(TRIALS):
            damped = matrix + np.diag(2.0 * self.prior + damping * spread)
            step = -np.linalg.solve(damped, gradient)
            step *= min(1.0, LARGEST / max(float(np.abs(step).max()), 1e-300))
            tried = self._cost(parameters + step)
            if tried < cost:
                return parameters + step, tried, max(damping / 3.0, LEAST)
            damping = max(4.0 * damping, FIRST)
        return None

    def _cost(self, parameters: Array) -> float:
        penalty = self.prior * float(parameters @ parameters)
        return self._mean(TRAINING, parameters) + penalty

    def _held_out(self, parameters: Array) -> float:
        return self._mean(HELD_OUT, parameters)

    def _mean(self, name: str, parameters: Array) -> float:
        """Returns the mean over samples and frames of the sum over markers of the costs."""
        errors = self.crew.errors(name, parameters)
        return float(robust_costs(errors, self.radius).sum(axis=-1).mean())
