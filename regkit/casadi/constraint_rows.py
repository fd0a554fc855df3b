"""Rows of constraints: named functions of a configuration, and the bounds that they keep."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np

from regkit.system.arrays import Array
from regkit.system.optional import load_library


@dataclass(frozen=True)
class ConstraintRows:
    """``lower <= g(configuration) <= upper``, in R rows.

    Attributes:
        names: What each row limits, such as ``left_shin`` or ``left_upper_arm.swing``, (R).
        function: The CasADi function configuration (Q,) -> g (R,).
        lower: (R,); -inf where there is no bound.
        upper: (R,); inf where there is no bound.
    """

    names: tuple[str, ...]
    function: Any
    lower: Array
    upper: Array

    def __len__(self) -> int:
        """Number R of rows."""
        return len(self.names)


@dataclass(frozen=True)
class Row:
    """One row: its name, its CasADi expression and its bounds."""

    name: str
    expression: Any
    lower: float
    upper: float


def accumulated(name: str, numbers: Any, rows: list[Row]) -> ConstraintRows:
    """Rows as one function, called ``name``, of the configuration ``numbers``."""
    ca = load_library("casadi")
    function = ca.Function(
        name, [numbers], [ca.vertcat(ca.SX(0, 1), *(row.expression for row in rows))],
        ["configuration"], ["rows"],
    )  # fmt: skip
    return ConstraintRows(
        tuple(row.name for row in rows),
        function,
        np.array([row.lower for row in rows]),
        np.array([row.upper for row in rows]),
    )
