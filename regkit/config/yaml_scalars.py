"""Scalars of YAML 1.2: null, booleans and numbers; all other plain scalars are text.

The words and notations of YAML 1.1 (``yes``, ``off``, ``1_000``, ``1:30``, dates) are text, so that
none of them becomes another value in silence.
"""

from __future__ import annotations

import math
import re

from regkit.config.strict_numbers import LARGEST_INTEGER

_NULL = frozenset({"", "~", "null", "Null", "NULL"})
_BOOLEANS = {
    **dict.fromkeys(("true", "True", "TRUE"), True),
    **dict.fromkeys(("false", "False", "FALSE"), False),
}
_NOT_FINITE = re.compile(r"([-+]?)\.(inf|Inf|INF)|\.(nan|NaN|NAN)")
_INTEGER = re.compile(r"[-+]?[0-9]+")
_OTHER_BASE = re.compile(r"0o[0-7]+|0x[0-9a-fA-F]+")
_FLOAT = re.compile(r"[-+]?(\.[0-9]+|[0-9]+(\.[0-9]*)?)([eE][-+]?[0-9]+)?")


def scalar(text: str) -> str | int | float | bool | None:
    """Returns the value of a plain scalar.

    Raises:
        ValueError: If it is a number that neither an integer of 64 bits nor a float can hold.
    """
    if text in _NULL:
        return None
    if text in _BOOLEANS:
        return _BOOLEANS[text]
    if _INTEGER.fullmatch(text) or _OTHER_BASE.fullmatch(text):
        return _integer(text)
    if special := _NOT_FINITE.fullmatch(text):
        sign, infinite, _ = special.groups()
        return math.nan if infinite is None else math.inf * (-1 if sign == "-" else 1)
    return _finite(text) if _FLOAT.fullmatch(text) else text


def _integer(text: str) -> int:
    # Python itself refuses to convert thousands of digits, with advice for programmers.
    digits = text.lstrip("+-0ox")
    base = {"0o": 8, "0x": 16}.get(text[:2], 10)
    value = int(digits or "0", base) if len(digits) <= 22 else LARGEST_INTEGER + 1
    if value > LARGEST_INTEGER:
        raise ValueError("is too large for an integer; text needs quotes")
    return -value if text[0] == "-" else value


def _finite(text: str) -> float:
    value = float(text)
    if math.isinf(value):
        raise ValueError("is too large for a number; text needs quotes")
    mantissa = re.split("[eE]", text)[0]
    if value == 0.0 and mantissa.strip("+-0."):
        raise ValueError("is too small for a number and would become 0; text needs quotes")
    return value
