"""Robust losses in compiled functions; ``Loss`` and its subclasses are the readable forms."""

from __future__ import annotations

import numpy as np

from regkit.registration.robust import GemanMcClure, Huber, Loss, Squares, Tukey
from regkit.system.compiled import compiled
from regkit.system.machine_types import SingleVector

SQUARES, HUBER, TUKEY, GEMAN_MCCLURE = 0.0, 1.0, 2.0, 3.0
_NUMBERS: dict[type[Loss], float] = {
    Squares: SQUARES,
    Huber: HUBER,
    Tukey: TUKEY,
    GemanMcClure: GEMAN_MCCLURE,
}
_HUBER, _TUKEY, _GEMAN_MCCLURE = Huber.tuning, Tukey.tuning**2, GemanMcClure.tuning**2


def loss_number(loss: type[Loss]) -> float:
    """Returns the number by which compiled functions know a loss."""
    return _NUMBERS[loss]


@compiled(reordered=True, python=False)
def write_losses(
    loss: float, residuals: SingleVector, scale: float, values: SingleVector, weights: SingleVector
) -> None:
    """Writes rho(u) and psi(u) / u, which is from 0 to 1, of residuals u in units of a scale.

    Args:
        loss: The loss's number.
        residuals: Residuals, (N,).
        scale: Their unit.
        values: Written, (N,).
        weights: Written, (N,).
    """
    zero, half, one = np.float32(0.0), np.float32(0.5), np.float32(1.0)
    inverse = np.float32(1.0 / scale)
    if loss == HUBER:
        tuning = np.float32(_HUBER)
        for j in range(len(residuals)):
            size = abs(residuals[j]) * inverse
            inner = min(size, tuning)
            values[j] = inner * (size - half * inner)
            weights[j] = tuning / max(size, tuning)
    elif loss == TUKEY:
        square, sixth = np.float32(_TUKEY), np.float32(_TUKEY / 6.0)
        for j in range(len(residuals)):
            size = residuals[j] * inverse
            rest = max(one - size * size / square, zero)
            values[j] = sixth * (one - rest * rest * rest)
            weights[j] = rest * rest
    elif loss == GEMAN_MCCLURE:
        square = np.float32(_GEMAN_MCCLURE)
        for j in range(len(residuals)):
            size = residuals[j] * inverse
            share = one / (one + size * size / square)
            values[j] = half * size * size * share
            weights[j] = share * share
    else:
        for j in range(len(residuals)):
            size = residuals[j] * inverse
            values[j], weights[j] = half * size * size, one
