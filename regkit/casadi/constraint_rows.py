"""Constraint rows: named, bounded functions of a configuration."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np

from regkit.system.arrays import Array
from regkit.system.optional import load_library


@dataclass(frozen=True)
class ConstraintRows:
    """R constraints ``lower <= g(configuration) <= upper``.

    Attributes:
        names: Name of each row, such as ``left_shin`` or ``left_upper_arm.swing``, (R,).
        function: The CasADi function configuration (Q,) -> g (R,).
        lower: Lower bounds, (R,); -inf for no bound.
        upper: Upper bounds, (R,); inf for no bound.
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
    """One constraint row.

    Attributes:
        name: Name of the row.
        expression: Scalar CasADi expression.
        lower: Lower bound; -inf for none.
        upper: Upper bound; inf for none.
    """

    name: str
    expression: Any
    lower: float
    upper: float


def accumulated(name: str, numbers: Any, rows: list[Row]) -> ConstraintRows:
    """Combines rows into one CasADi function of a configuration.

    Args:
        name: Name of the function.
        numbers: The symbol of the configuration, (Q,).
        rows: The rows, expressions of ``numbers``.
    """
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
