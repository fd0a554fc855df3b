"""Robust losses in compiled functions; ``Loss`` and its subclasses are the readable forms."""

from __future__ import annotations

from math import sqrt

from regkit.registration.robust import GemanMcClure, Huber, Loss, Squares, Tukey
from regkit.system.compiled import compiled

SQUARES, HUBER, TUKEY, GEMAN_MCCLURE = 0.0, 1.0, 2.0, 3.0
_NUMBERS: dict[type[Loss], float] = {
    Squares: SQUARES,
    Huber: HUBER,
    Tukey: TUKEY,
    GemanMcClure: GEMAN_MCCLURE,
}
_HUBER, _TUKEY, _GEMAN_MCCLURE = Huber.tuning**2, Tukey.tuning**2, GemanMcClure.tuning**2


def loss_number(loss: type[Loss]) -> float:
    """Returns the number by which compiled functions know a loss."""
    return _NUMBERS[loss]


@compiled
def loss_value(loss: float, square: float) -> float:
    """Returns rho(u) from u^2."""
    if loss == HUBER:
        inner = sqrt(min(square, _HUBER))
        return inner * (sqrt(square) - 0.5 * inner)
    if loss == TUKEY:
        rest = max(1.0 - square / _TUKEY, 0.0)
        return _TUKEY / 6.0 * (1.0 - rest * rest * rest)
    if loss == GEMAN_MCCLURE:
        return 0.5 * square / (1.0 + square / _GEMAN_MCCLURE)
    return 0.5 * square


@compiled
def loss_weight(loss: float, square: float) -> float:
    """Returns psi(u) / u, from 0 to 1, from u^2."""
    if loss == HUBER:
        return sqrt(_HUBER / max(square, _HUBER))
    if loss == TUKEY:
        rest = max(1.0 - square / _TUKEY, 0.0)
        return rest * rest
    if loss == GEMAN_MCCLURE:
        rest = 1.0 + square / _GEMAN_MCCLURE
        return 1.0 / (rest * rest)
    return 1.0
