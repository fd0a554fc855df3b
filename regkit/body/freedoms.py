"""Free parameters of a primitive, by which a template's shape is optimised."""

from __future__ import annotations

from collections.abc import Sequence
from enum import Enum

import numpy as np

from regkit.body.deformation import REFLECT
from regkit.system.arrays import Array, read_only

MIRROR = read_only(np.diag(REFLECT))
"""Reflection in the plane x = 0, (3, 3)."""


class Freedom(Enum):
    """The kind of one free parameter, or of three that form a vector, in the segment's frame."""

    POSITION = "position"
    """A position (3,): the step [m] is added."""
    LOG_SCALE = "log_scale"
    """The logarithm of a length: the length is multiplied by the exponential of the step."""
    LOG_WEIGHT = "log_weight"
    """The logarithm of a weight: the weight is multiplied by the exponential of the step, and the
    moments stay."""
    ROTATION = "rotation"
    """The rotation of the primitive's own axes (3,): ``R_new = exp(step) R`` for a rotation vector
    [rad] in the segment's frame."""

    @property
    def size(self) -> int:
        """Number of the step's coordinates: 3, or 1 for a logarithm."""
        return 3 if self in (Freedom.POSITION, Freedom.ROTATION) else 1

    def mirrored(self, step: Array, reflection: Array) -> Array:
        """Returns the part (..., size) of the step of a mirror image.

        Args:
            step: This parameter's part of the step, (..., size).
            reflection: Orthogonal matrix of determinant -1, (3, 3).
        """
        match self:
            case Freedom.POSITION:
                return np.asarray(step @ reflection.T)
            case Freedom.LOG_SCALE | Freedom.LOG_WEIGHT:
                return step
            case Freedom.ROTATION:
                # The sense of a rotation reverses in the mirror.
                return np.asarray(-step @ reflection.T)


def step_size(freedoms: Sequence[Freedom]) -> int:
    """Returns the number P of coordinates of a step in some free parameters."""
    return sum(one.size for one in freedoms)


def step_parts(freedoms: Sequence[Freedom], step: Array) -> list[Array]:
    """Returns the part (..., size) of each free parameter in a step (..., P).

    Raises:
        ValueError: If the step has another size.
    """
    if step.shape[-1] != step_size(freedoms):
        raise ValueError(f"a step of {step.shape[-1]} coordinates, of {step_size(freedoms)}")
    ends = np.cumsum([one.size for one in freedoms], dtype=np.intp)
    return np.split(step, ends[:-1], axis=-1) if freedoms else []
