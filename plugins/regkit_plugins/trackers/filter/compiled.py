"""Prediction of a posterior to the next frame, in a compiled loop."""

from __future__ import annotations

from math import sqrt

import numpy as np

from regkit.registration.compiled_posterior import inverted
from regkit.system.compiled import compiled
from regkit.system.machine_types import IntegerVector, Matrix, Vector


@compiled
def predicted_information(
    covariance: Matrix,
    noise: Vector,
    motion: Vector,
    spread: Vector,
    leaders: IntegerVector,
    first: int,
) -> Matrix:
    """Returns the inverse of ``A P A + Q`` on the independent degrees of freedom, (n, n).

    The rows of coupled hinges, which have no motion of their own, are zero. The diagonal A lets a
    variance that only grows end at the spread of the limits.

    Args:
        covariance: P, (n, n).
        noise: Diagonal of Q for a joint at rest, (n,).
        motion: What is uncertain of the motion, (n,); a joint's turns add up over its axes.
        spread: Greatest variances, (n,).
        leaders: Hinge that each hinge follows, (n_hinge,); itself if it follows none.
        first: Number of degrees of freedom of the root.
    """
    dofs = len(noise)
    hinges = dofs - len(leaders)
    own, count = np.empty(dofs, np.int64), 0
    for dof in range(dofs):
        if dof < hinges or leaders[dof - hinges] == dof - hinges:
            own[count] = dof
            count += 1
    total, lasting = np.empty(dofs), np.empty(dofs)
    for at in range(0, hinges, 3):
        square = motion[at] ** 2 + motion[at + 1] ** 2 + motion[at + 2] ** 2
        for dof in range(at, at + 3):
            total[dof] = noise[dof] + square
    for dof in range(hinges, dofs):
        total[dof] = noise[dof] + motion[dof] ** 2
    for dof in range(dofs):
        total[dof] = min(total[dof], spread[dof])
        lasting[dof] = sqrt(1.0 - total[dof] / spread[dof])
    wider = np.empty((count, count))
    for i in range(count):
        a = own[i]
        for j in range(count):
            b = own[j]
            wider[i, j] = lasting[a] * covariance[a, b] * lasting[b]
        wider[i, i] += total[a]
    inverse, information = inverted(wider), np.zeros((dofs, dofs))
    for i in range(count):
        for j in range(count):
            information[own[i], own[j]] = inverse[i, j]
    return information


@compiled
def unforeseen_noise(
    information: Matrix, step: Vector, usual: float, share: float, hinges: int
) -> Vector:
    """Returns the process noise (n,) of the joints that moved farther than a prior lets expect.

    The squared Mahalanobis distance is divided among the joints. Where the part of a joint is more
    than ``usual`` per degree of freedom, its noise is a share of the square of its step.

    Args:
        information: Inverse of the prior's covariance, (n, n).
        step: Step from the prior's pose, (n,).
        usual: Squared distance per degree of freedom that is no surprise.
        share: Variance per square of the step.
        hinges: Index of the first hinge.
    """
    noise, pull = np.zeros(len(step)), information @ step
    for at in range(0, hinges, 3):
        distance = square = 0.0
        for dof in range(at, at + 3):
            distance += step[dof] * pull[dof]
            square += step[dof] ** 2
        if distance > 3.0 * usual:
            noise[at : at + 3] = share * square
    for dof in range(hinges, len(step)):
        if step[dof] * pull[dof] > usual:
            noise[dof] = share * step[dof] ** 2
    return noise
