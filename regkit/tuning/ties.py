"""Ties: which free parameters of a body's primitives change together."""

from __future__ import annotations

import numpy as np
import scipy

from regkit.body import Body, ListedShape, ShapeParameters
from regkit.body.freedoms import Freedom, step_size
from regkit.skeleton import Mirroring, Placement
from regkit.system.arrays import Array

POSITION = 0.2
"""A position's unit as a fraction of a typical limb's radius: 1 cm of a person, 2 mm of a hand."""

UNITS = {Freedom.LOG_SCALE: 0.1, Freedom.ROTATION: 0.1, Freedom.LOG_WEIGHT: 0.2}
"""Units of the other free parameters: steps that change an energy about as much."""

APART = 0.5
"""Greatest distance of a primitive from the mirror image of its counterpart, as a fraction of a
typical limb's radius."""

ALIKE = 0.1
"""Greatest difference between the lengths of both, as a fraction."""


def tied_steps(body: Body, listed: ListedShape[ShapeParameters]) -> Array:
    """Returns the steps of all free parameters for a unit step in each independent one, (P, F).

    The parameters of a primitive and of its mirror image on the other side of the body are one; a
    primitive in the middle keeps its symmetry. A body without sides has no ties.

    Args:
        body: The body.
        listed: Its primitives.

    Returns:
        A matrix from F independent parameters, in units that change an energy about as much, to
        the P coordinates of the steps of all primitives, one after the other.
    """
    own = [one.freedoms() for one in listed.parameters]
    ends = np.cumsum([0, *map(step_size, own)])
    columns: list[Array] = []
    for index, (other, reflection) in enumerate(_counterparts(body, listed)):
        size = int(ends[index + 1] - ends[index])
        if other < index:
            continue
        steps = _units(own[index], body.limb_radius)
        one = listed.parameters[index]
        if other == index and reflection is not None:
            steps = _symmetric(one, own[index], reflection) @ steps
        for step in steps:
            column = np.zeros(ends[-1])
            column[ends[index] : ends[index] + size] = step
            if other != index:
                assert reflection is not None
                column[ends[other] : ends[other + 1]] = one.mirrored_step(step, reflection)
            columns.append(column)
    return np.array(columns).reshape(-1, ends[-1]).T


def _units(freedoms: tuple[Freedom, ...], radius: float) -> Array:
    """Returns a unit step for each coordinate of a primitive's step, (P, P)."""
    units = {Freedom.POSITION: POSITION * radius, **UNITS}
    return np.diag([units[one] for one in freedoms for _ in range(one.size)])


def _symmetric(one: ShapeParameters, freedoms: tuple[Freedom, ...], reflection: Array) -> Array:
    """Returns an orthonormal basis (B, P) of the steps that are their own mirror image.

    Each vector belongs to one free parameter, so that its unit is that of the parameter.
    """
    projection = 0.5 * (np.eye(step_size(freedoms)) + one.mirrored_step(
        np.eye(step_size(freedoms)), reflection
    ))  # fmt: skip
    bases, at = [], 0
    for freedom in freedoms:
        part = slice(at, at + freedom.size)
        basis = scipy.linalg.orth(projection[part, part].T).T
        whole = np.zeros((len(basis), len(projection)))
        whole[:, part] = basis
        bases.append(whole)
        at += freedom.size
    return np.concatenate(bases)


def _counterparts(
    body: Body, listed: ListedShape[ShapeParameters]
) -> list[tuple[int, Array | None]]:
    """Returns the primitive on the other side for each, and the reflection into its frame.

    A primitive without a counterpart is its own, without a reflection.
    """
    alone: list[tuple[int, Array | None]] = [(index, None) for index in range(len(listed))]
    mirroring = Mirroring.of(body.skeleton)
    if mirroring is None:
        return alone
    reflection = np.eye(3) - 2.0 * np.outer(mirroring.normal, mirroring.normal)
    placed = Placement.of(body.skeleton, body.skeleton.rest()).transforms[listed.segments]
    moments = [one.moments() for one in listed.parameters]
    means = np.array([at[:3, :3] @ mean + at[:3, 3]
                      for at, (mean, _) in zip(placed, moments, strict=True)])  # fmt: skip
    gaps = np.linalg.norm((means @ reflection)[:, None] - means, axis=2)
    nearest = gaps.argmin(axis=1)
    found = []
    for index, other in enumerate(nearest.tolist()):
        into = placed[other][:3, :3].T @ reflection @ placed[index][:3, :3]
        image = into @ moments[index][1] @ into.T
        size = np.abs(moments[other][1]).max()
        both = (
            nearest[other] == index
            and gaps[index, other] <= APART * body.limb_radius
            and np.abs(image - moments[other][1]).max() <= 2.0 * ALIKE * size
            and listed.parameters[other].freedoms() == listed.parameters[index].freedoms()
        )
        found.append((other, into) if both else alone[index])
    return found
