"""Exponential and logarithm in single precision, for long compiled loops.

Both are polynomials without branches, which the compiler turns into vector instructions together
with the loop around them; the library's functions would be called once for each number. The
coefficients minimise the greatest error on the reduced range.
"""

from __future__ import annotations

import numpy as np

from regkit.system.compiled import compiled

LOG2_E = 1.4426950408889634
"""An exponent divided by log 2 is one of a power of two."""

_LEAST = np.float32(-80.0)
"""Lower bound of exponents of two. The power is negligible there (1e-24), while numbers near
underflow slow the processor up to a hundredfold."""

_P0, _P1, _P2 = np.float32(1.00000007), np.float32(0.693146967), np.float32(0.240221197)
_P3, _P4, _P5 = np.float32(0.0555071327), np.float32(0.00967554138), np.float32(0.0013276472)
"""2^r = P0 + P1 r + ... for -1/2 <= r <= 1/2, with a relative error of 7e-8."""

_Q0, _Q1, _Q2 = np.float32(0.999999881), np.float32(-0.499999728), np.float32(0.333350095)
_Q3, _Q4, _Q5 = np.float32(-0.25003288), np.float32(0.199388413), np.float32(-0.165329072)
_Q6, _Q7, _Q8 = np.float32(0.150675905), np.float32(-0.145771192), np.float32(0.0869293094)
"""log(1 + r) / r = Q0 + Q1 r + ... for sqrt(1/2) <= 1 + r <= sqrt(2), within 5e-9 / r."""

_BIAS, _FRACTION = np.int32(127), np.int32(23)
"""A number 2^n has n + 127 in its bits, above 23 bits of the fraction."""

_ROOT_HALF = np.int32(0x3F3504F3)
"""The bits of sqrt(1/2)."""

_LOG_2, _ONE = np.float32(0.6931471805599453), np.float32(1.0)


@compiled(reordered=True)
def power_of_two(exponent: np.float32) -> np.float32:
    """Returns 2^x with a relative error of 3e-7; x of at most 127 counts as at least -80."""
    x = max(np.float32(exponent), _LEAST)
    whole = np.rint(x)
    r = x - whole
    power = ((((_P5 * r + _P4) * r + _P3) * r + _P2) * r + _P1) * r + _P0
    scale: np.float32 = np.int32((np.int32(whole) + _BIAS) << _FRACTION).view(np.float32)
    return np.float32(power * scale)


@compiled(reordered=True)
def logarithm(number: np.float32) -> np.float32:
    """Returns log x of a positive normal number, within 1e-6 for the largest and the smallest."""
    bits = np.float32(number).view(np.int32)
    whole = np.int32((bits - _ROOT_HALF) >> _FRACTION)
    r = np.int32(bits - (whole << _FRACTION)).view(np.float32) - _ONE
    series = (((_Q8 * r + _Q7) * r + _Q6) * r + _Q5) * r + _Q4
    series = (((series * r + _Q3) * r + _Q2) * r + _Q1) * r + _Q0
    return series * r + np.float32(whole) * _LOG_2
