"""Axes of data that differ from those of the camera's frame."""

from __future__ import annotations

from typing import Annotated, Literal

import numpy as np
from pydantic import AfterValidator

from regkit.system.arrays import Array

Axis = Literal["x", "y", "z", "-x", "-y", "-z"]


def _each_once(axes: tuple[Axis, Axis, Axis]) -> tuple[Axis, Axis, Axis]:
    if {axis[-1] for axis in axes} != {"x", "y", "z"}:
        raise ValueError(f"each of x, y and z must be named once, not {', '.join(axes)}")
    return axes


Axes = Annotated[tuple[Axis, Axis, Axis], AfterValidator(_each_once)]
"""The data's axes along the camera's x (right), y (down) and z (forward), with their signs."""


def in_camera(points: Array, axes: Axes) -> Array:
    """Returns points (..., 3) of the data in the camera's frame (x right, y down, z forward)."""
    order = ["xyz".index(axis[-1]) for axis in axes]
    signs = np.array([-1.0 if axis[0] == "-" else 1.0 for axis in axes])
    turned: Array = np.asarray(points, dtype=np.float64)[..., order] * signs
    return turned
