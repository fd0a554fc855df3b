"""Gradients and curvatures of a registration problem against differences of its energy."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from regkit.body import Body
from regkit.interfaces import Problem
from regkit.system.arrays import Array

STEP = 1e-6
SLOPE_TOLERANCE = 1e-4
"""Of a slope against the difference quotient, as a part of the largest slope."""


@dataclass(frozen=True)
class Slopes:
    """A gradient beside difference quotients of the energy.

    Attributes:
        claimed: The gradient, (n,).
        measured: Central differences, (n,).
    """

    claimed: Array
    measured: Array

    @classmethod
    def of(cls, problem: Problem, x: Array) -> Slopes:
        """Those of a problem at x (n,)."""
        _, gradient = problem.value_and_gradient(x)
        ends = [
            [problem.value_and_gradient(x + sign * STEP * e)[0] for sign in (1.0, -1.0)]
            for e in np.eye(len(x))
        ]
        return cls(gradient, np.array([a - b for a, b in ends]) / (2.0 * STEP))

    @property
    def largest(self) -> float:
        """The steepest of the measured slopes."""
        return float(np.abs(self.measured).max())

    @property
    def errors(self) -> Array:
        """The differences, (n,), as parts of the largest slope."""
        return np.asarray(np.abs(self.claimed - self.measured) / max(self.largest, 1e-300))

    def agree(self) -> bool:
        """Whether they are the same but for rounding."""
        return bool((self.errors < SLOPE_TOLERANCE).all())

    def told(self, body: Body) -> str:
        """What an author should know: the worst degree of freedom, and which ones are right."""
        names = _dofs(body)
        worst = int(self.errors.argmax())
        text = (
            f"has a gradient that is not the derivative of its energy: at {names[worst]} it claims "
            f"{self.claimed[worst]:.6g}, differences give {self.measured[worst]:.6g}"
        )
        wrong = self.errors >= SLOPE_TOLERANCE
        if body.skeleton.free and not wrong[:3].any():
            return text + " (the forces are right, so it is the torques)"
        if np.allclose(self.claimed, -self.measured, atol=SLOPE_TOLERANCE * self.largest):
            return text + " (all signs are wrong: it must point uphill)"
        return text


def _dofs(body: Body) -> list[str]:
    """A name for each degree of freedom."""
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
    """By which power of two a step (n,) from x (n,) is to be multiplied to go lowest."""
    lengths = 2.0 ** np.arange(-14, 10)
    energies = [problem.value_and_gradient(x + length * step)[0] for length in lengths]
    return float(lengths[int(np.argmin(energies))])
