"""Vectors as triples of numbers, as in YAML."""

from __future__ import annotations

from regkit.skeleton.joints import Vector
from regkit.system.arrays import Array


def vector(values: Array) -> Vector:
    """Returns an array (3,) as a triple."""
    x, y, z = values.tolist()
    return (x, y, z)


def rounded(values: Array, decimals: int = 4) -> Vector:
    """Returns a rounded triple; four decimals are a tenth of a millimetre."""
    x, y, z = (round(float(value), decimals) + 0.0 for value in values)
    return (x, y, z)
