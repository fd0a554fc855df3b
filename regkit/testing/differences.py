"""Comparison of a problem's gradients and curvatures with finite differences of its energy."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from regkit.body import Body
from regkit.interfaces import Problem
from regkit.system.arrays import Array

STEP = 1e-6
SLOPE_TOLERANCE = 1e-4
"""Tolerance between gradient and difference quotient, relative to the largest component."""


@dataclass(frozen=True)
class Slopes:
    """A gradient and difference quotients of the energy.

    Attributes:
        claimed: The gradient, (n,).
        measured: Central differences, (n,).
    """

    claimed: Array
    measured: Array

    @classmethod
    def of(cls, problem: Problem, x: Array) -> Slopes:
        """Returns the gradients of a problem at x (n,)."""
        _, gradient = problem.value_and_gradient(x)
        ends = [
            [problem.value_and_gradient(x + sign * STEP * e)[0] for sign in (1.0, -1.0)]
            for e in np.eye(len(x))
        ]
        return cls(gradient, np.array([a - b for a, b in ends]) / (2.0 * STEP))

    @property
    def largest(self) -> float:
        """Largest absolute value of the measured gradient."""
        return float(np.abs(self.measured).max())

    @property
    def errors(self) -> Array:
        """Differences (n,), relative to the largest component."""
        return np.asarray(np.abs(self.claimed - self.measured) / max(self.largest, 1e-300))

    def agree(self) -> bool:
        """Whether both agree apart from rounding."""
        return bool((self.errors < SLOPE_TOLERANCE).all())

    def message(self, body: Body) -> str:
        """Returns a message with the worst degree of freedom, and a hint at the cause."""
        names = _dofs(body)
        worst = int(self.errors.argmax())
        text = (
            f"has a gradient that is not the derivative of its energy: at {names[worst]} it is "
            f"{self.claimed[worst]:.6g}, but differences give {self.measured[worst]:.6g}"
        )
        wrong = self.errors >= SLOPE_TOLERANCE
        if body.skeleton.free and not wrong[:3].any():
            return text + " (the forces are right, so the torques are wrong)"
        if np.allclose(self.claimed, -self.measured, atol=SLOPE_TOLERANCE * self.largest):
            return text + " (all signs are wrong: it must point uphill)"
        return text


def _dofs(body: Body) -> list[str]:
    """Returns a name for each degree of freedom."""
    bones = body.skeleton
    names = [f"degree of freedom {index}" for index in range(bones.dofs)]
    if bones.free:
        names[:6] = [f"the root's {what} {axis}" for what in ("shift", "turn") for axis in "xyz"]
    for joint, dofs in bones.joint_dofs.items():
        for freedom in dofs:
            if freedom >= (6 if bones.free else 0):
                names[freedom] = f"joint '{joint}'"
    return names


def best_length(problem: Problem, x: Array, step: Array) -> float:
    """Returns the power of two by which the step (n,) from x (n,) reaches the lowest energy."""
    lengths = 2.0 ** np.arange(-14, 10)
    energies = [problem.value_and_gradient(x + length * step)[0] for length in lengths]
    return float(lengths[int(np.argmin(energies))])
